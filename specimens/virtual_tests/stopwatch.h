// Seconds that a test took, over its stops.
#pragma once
#include <chrono>

namespace virtual_tests {

/// Seconds since it was made, and those of the parts before a stop.
struct Stopwatch {
  double before = 0;  ///< [s]
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double seconds() const {
    return before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
};

}  // namespace virtual_tests
