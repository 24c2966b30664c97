#include <fstream>

#include "impact/fe/gmsh_mesh.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

// Gmsh's library opens files alone.
void fuzz::gmsh(std::string_view bytes) {
  static const std::string name = (scratch_folder() / "slab.msh").string();
  std::ofstream(name, std::ios::binary) << bytes;
  take_refusal([&] { fe::read_gmsh(name, 0.001); });
}
