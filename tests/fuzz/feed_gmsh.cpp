#include "impact/fe/gmsh_mesh.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::gmsh(std::string_view bytes) {
  read_as_file("slab.msh", bytes, [](const auto& file) { fe::read_gmsh(file.string(), 0.001); });
}
