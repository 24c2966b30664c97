// How long a task will take and how much memory it needs, before it is run.
#pragma once
#include "study/study_file.h"

namespace study {

struct Estimate {
  double seconds = 0;  ///< on one core
  double bytes = 0;
};

/// From the number of elements and the steps that the test's speed and the elements' size imply, at the rates
/// of one core that docs/studies.md names. Good to a factor of two on another machine; what matters to the
/// runner is which task is longer.
Estimate estimate_test(const specimens::PackingOptions& specimen, const dem::MaterialCard& card,
                       const VirtualTest& test);
Estimate estimate_packing(const specimens::PackingOptions& specimen);

}  // namespace study
