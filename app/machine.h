// The machine that a run happened on, for its provenance.
#pragma once
#include <string>

namespace app {

struct Machine {
  std::string cpu;     ///< model, as the system names it
  int cores = 0;       ///< online
  double memory = 0;   ///< [bytes]
  std::string kernel;  ///< "Linux 6.1.0"
  std::string arch;    ///< "x86_64"
};

/// Reads /proc and uname; what the system does not tell stays "unknown" or 0.
Machine this_machine();

}  // namespace app
