// Runs a laboratory test, quasi-static, to past its peak: the driver of every Rig.
#pragma once
#include <string>

#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"
#include "specimens/virtual_tests/checkpoint_policy.h"
#include "specimens/virtual_tests/outcome.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

/// Runs the test. `sha256_of_options` names everything in the test's options on which its bits depend. Throws
/// InputError for a card, an option or a checkpoint that is not valid, RunError if it diverges (NaN, with the
/// step) or cannot write its checkpoint, Interrupted on a signal, after the step under way and with a
/// checkpoint if one is kept. A test that was stopped and goes on gives the bits of one that was not, on any
/// number of threads.
TestOutcome run_rig(Rig& rig, const dem::MaterialCard& card, const QuasiStaticOptions& options,
                    const std::string& sha256_of_options, const dem::ProgressCallback& progress = {},
                    const CheckpointPolicy& checkpoint = {});

}  // namespace virtual_tests
