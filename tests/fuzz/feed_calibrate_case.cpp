#include "calibrate/calibration_case.h"
#include "libdem/config/toml_reader.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::calibrate_case(std::string_view bytes) {
  // Files that it names are looked for beside it.
  static const std::string name = (scratch_folder() / "case.toml").string();
  take_refusal([&] { calibrate::case_of(dem::TomlTable::parse(bytes, name)); });
}
