#include "impact/fe/gmsh_mesh.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

// What the process that reads a mesh with Gmsh's library sends.
void fuzz::gmsh_content(std::string_view bytes) {
  take_refusal([&] { fe::mesh_of(fe::gmsh_content(bytes, "slab.msh"), "slab.msh", 0.001); });
}
