// What to keep of a long virtual test: its state, so that it can be stopped and go on, and pictures of its
// course.
#pragma once
#include <filesystem>

namespace virtual_tests {

/// Without a file a stopped test starts anew.
struct CheckpointPolicy {
  std::filesystem::path file{};  ///< empty: no checkpoint is kept
  double seconds_between = 60;   ///< it is also written this often, so that a crash costs no more [s]
  bool resume = false;           ///< go on from `file`, if it is there
  long stop_after = 0;           ///< stop after this step as if a signal had come; 0: never
  int pictures = 0;              ///< of the test's course, this many to twice as many; 0: none
};

}  // namespace virtual_tests
