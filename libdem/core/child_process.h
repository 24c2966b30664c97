// Work on a file that a library of others may not survive, done in a process of its own.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace dem {

/// What a damaged file may make a library take before the child is ended, or told that there is no more.
struct ChildLimits {
  static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t memory = none;   ///< beside what it begins with [bytes of address space]
  std::uint64_t seconds = none;  ///< of a processor's time
};

/// Starts a copy of this process that does `work` and ends, silently: in success if it returns, else in
/// failure. It leaves no core, nothing that this process would do at its end, and does not outlive it; of a
/// stop by signals it takes no notice. `work` must start no threads. Throws RunError if no process can be
/// started.
pid_t start_child(const std::function<void()>& work, const ChildLimits& limits = {});

struct ChildEnd {
  bool succeeded = false;
  std::string crash;  ///< the signal that ended it ("Segmentation fault"), or empty
};
/// Waits for its end.
ChildEnd wait_for_child(pid_t child);

}  // namespace dem
