#include "libdem/run/checkpoint_interval.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "libdem/core/error.h"

namespace dem {
namespace {

constexpr const char* variable = "SPALL_CHECKPOINT_SECONDS";
constexpr double times_as_long_as_writing = 200;

}  // namespace

double seconds_between_checkpoints(double usual) {
  const char* const wanted = std::getenv(variable);
  if (wanted == nullptr) return usual;
  char* end = nullptr;
  const double seconds = std::strtod(wanted, &end);
  if (end == wanted || *end != 0 || !(seconds >= 0))
    throw InputError(variable, fmt::format("is \"{}\"", wanted), "give a number from 0");
  return seconds;
}

CheckpointPace::CheckpointPace(double interval_wanted)
    : interval(interval_wanted),
      factor(std::getenv(variable) == nullptr ? times_as_long_as_writing : 0),
      seconds_to_wait(interval) {}

bool CheckpointPace::is_due() const {
  return std::chrono::duration<double>(Clock::now() - kept).count() >= seconds_to_wait;
}

void CheckpointPace::keep(const std::function<void()>& write) {
  const Clock::time_point before = Clock::now();
  write();
  kept = Clock::now();
  seconds_to_wait = std::max(interval, factor * std::chrono::duration<double>(kept - before).count());
}

}  // namespace dem
