#include "libdem/config/toml_reader.h"
#include "study/plan.h"
#include "study/study_file.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::study_file(std::string_view bytes) {
  // Files that it names are looked for beside it.
  static const std::string name = (scratch_folder() / "study.toml").string();
  take_refusal([&] { study::make_plan(study::study_of(dem::TomlTable::parse(bytes, name))); });
}
