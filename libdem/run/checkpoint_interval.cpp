#include "libdem/run/checkpoint_interval.h"

#include <fmt/format.h>

#include <cstdlib>

#include "libdem/core/error.h"

namespace dem {

double seconds_between_checkpoints(double usual) {
  const char* const wanted = std::getenv("SPALL_CHECKPOINT_SECONDS");
  if (wanted == nullptr) return usual;
  char* end = nullptr;
  const double seconds = std::strtod(wanted, &end);
  if (end == wanted || *end != 0 || !(seconds >= 0.01))
    throw InputError("SPALL_CHECKPOINT_SECONDS", fmt::format("is \"{}\"", wanted), "give a number from 0.01");
  return seconds;
}

}  // namespace dem
