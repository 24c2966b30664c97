#include "libdem/core/instructions.h"

#include <cstdlib>

#include "libdem/core/error.h"

namespace dem {
namespace {

Instructions widest() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return Instructions::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Instructions::avx2;
#endif
  return Instructions::baseline;
}

Instructions choose() {
  const char* text = std::getenv("SPALL_INSTRUCTIONS");
  const std::string_view wanted = text == nullptr ? "" : text;
  if (wanted.empty()) return widest();
  for (const Instructions set : {Instructions::baseline, Instructions::avx2, Instructions::avx512})
    if (wanted == name_of(set)) return set < widest() ? set : widest();
  throw InputError("SPALL_INSTRUCTIONS", "\"" + std::string(wanted) + "\" is no instruction set",
                   "allowed: baseline, avx2, avx512");
}

}  // namespace

Instructions instructions() {
  static const Instructions chosen = choose();
  return chosen;
}

std::string_view name_of(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return "avx512";
    case Instructions::avx2:
      return "avx2";
    case Instructions::baseline:
      break;
  }
  return "baseline";
}

}  // namespace dem
