// Independent pieces of work side by side on the cores.
#pragma once
#include <cstddef>
#include <exception>
#include <vector>

#include "libdem/core/interrupt.h"

namespace dem {

/// Calls action(0) to action(count - 1), each once, on `threads` threads, in about that order: put long ones
/// first. Waits for all of them, then throws what the first of those that threw has thrown. A request to stop
/// the calling thread's job reaches all of them.
template <class Action>
void for_each_in_parallel(std::size_t count, int threads, Action&& action) {
  std::vector<std::exception_ptr> failures(count);
  const auto end = static_cast<std::ptrdiff_t>(count);
  const StopRequest* const stop = stop_request();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::ptrdiff_t k = 0; k < end; ++k) {
    const StopScope scope(stop);
    try {
      action(static_cast<std::size_t>(k));
    } catch (...) {
      failures[static_cast<std::size_t>(k)] = std::current_exception();
    }
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace dem
