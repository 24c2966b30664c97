#include "specimens/specimen_file.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::specimen(std::string_view bytes) {
  read_as_file("s.h5", bytes, [](const auto& file) { specimens::read_specimen(file); });
}
