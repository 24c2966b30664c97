#include "impact/scene_file.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::impact_scene(std::string_view bytes) {
  read_as_file("slab.toml", bytes, [](const auto& file) { impact::read_scene(file, std::nullopt); });
}
