#include "calibrate/test_bench.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/seal.h"

void fuzz::journal(std::string_view bytes) {
  read_sealed(bytes, "checkpoint.h5", [](const dem::Hdf5File& file) { calibrate::TestJournal().read(file); });
}
