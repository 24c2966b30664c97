// Progress is a plain struct handed to a callback; whoever runs a long job decides what to do with it.
#pragma once
#include <functional>
#include <string>

namespace dem {

/// Where a long job stands. `done` and `total` count the same thing (named by `unit`); total is 0 when it is
/// unknown.
struct Progress {
  std::string stage;   ///< what is being done now, e.g. "compression, seed 3"
  double done = 0;     ///< how much of it is done
  double total = 0;    ///< how much there is
  std::string unit;    ///< "steps", "virtual tests", ...
  std::string detail;  ///< one short remark, e.g. "ft 2.97 MPa (target 3.00)"
};

/// Called now and then from the thread that started the job, or under its lock. An empty function is allowed.
using ProgressCallback = std::function<void(const Progress&)>;

}  // namespace dem
