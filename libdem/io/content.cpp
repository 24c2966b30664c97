#include "libdem/io/content.h"

namespace dem {
namespace {

// By libFuzzer's custom: nearly every change that a fuzzer makes would end at the sum.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool sum_matters = false;
#else
constexpr bool sum_matters = true;
#endif

}  // namespace

void ContentReader::require_seal() {
  const std::string named = file.text_attribute("/", "sha256"), found = hash.hex();
  if (sum_matters && found != named) throw WrongSum(file.path(), named, found);
}

}  // namespace dem
