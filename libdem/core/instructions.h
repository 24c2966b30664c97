// Which instruction set to run: the widest that the machine has, or a narrower one by name.
#pragma once
#include <string_view>

namespace dem {

enum class Instructions { baseline, avx2, avx512 };

/// Chosen once per process. The environment variable SPALL_INSTRUCTIONS (baseline, avx2, avx512) can only
/// narrow it. Throws InputError if the variable holds anything else.
Instructions instructions();
std::string_view name_of(Instructions instructions);

/// Calls the maker that belongs to the chosen set.
template <class Make>
auto choose_instructions(Make baseline, Make avx2, Make avx512) {
  switch (instructions()) {
    case Instructions::avx512:
      return avx512();
    case Instructions::avx2:
      return avx2();
    case Instructions::baseline:
      break;
  }
  return baseline();
}
template <class Make>
auto choose_instructions(Make baseline) {
  return baseline();
}

}  // namespace dem
