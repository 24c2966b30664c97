#include "calibrate/calibration_case.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::calibrate_case(std::string_view bytes) {
  read_as_file("case.toml", bytes, [](const auto& file) { calibrate::read_case(file); });
}
