// The entry that libFuzzer calls; the build says which reader is meant.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/feeds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::SPALL_FUZZ_FEED({reinterpret_cast<const char*>(data), size});
  return 0;
}
