#include "calibrate/test_bench.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::journal(std::string_view bytes) {
  read_as_file("checkpoint.h5", bytes, [](const auto& file) { calibrate::TestJournal(file, true); });
}
