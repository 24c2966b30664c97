#include "impact/scene_file.h"
#include "libdem/config/toml_reader.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::impact_scene(std::string_view bytes) {
  // Files that it names are looked for beside it.
  static const std::string name = (scratch_folder() / "slab.toml").string();
  take_refusal([&] { impact::scene_of(dem::TomlTable::parse(bytes, name), std::nullopt); });
}
