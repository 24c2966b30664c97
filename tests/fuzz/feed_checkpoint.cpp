#include "libdem/run/checkpoint.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/verification/scene.h"

// Into an assembly of three elements and two links, which belongs to nothing.
void fuzz::checkpoint(std::string_view bytes) {
  dem::Assembly assembly = scene::chain(3, scene::plain_law());
  dem::StepRoom room(assembly);
  read_as_file("checkpoint.h5", bytes,
               [&](const auto& file) { dem::read_checkpoint(file, {}, assembly, room); });
}
