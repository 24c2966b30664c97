// When a uniaxial test writes its checkpoint, and how it goes on from one.
#pragma once
#include "libdem/run/checkpoint.h"
#include "specimens/virtual_tests/uniaxial_record.h"

namespace virtual_tests {

/// Looks after each step whether it is time to write, or to stop.
class CheckpointKeeper {
 public:
  CheckpointKeeper(const CheckpointPolicy& policy, const specimens::Specimen& specimen,
                   const dem::MaterialCard& card, const UniaxialOptions& options);

  /// Goes on from the checkpoint if that is wanted and it is there. Throws InputError if it does not fit.
  void restore(dem::Assembly& assembly, dem::StepRoom& room, UniaxialRecord& record) const;

  /// Writes a checkpoint when it is due. Throws Interrupted, after writing one, if a signal asked for a stop.
  void look(dem::Assembly& assembly, const dem::StepRoom& room, const UniaxialRecord& record);

 private:
  void write(dem::Assembly& assembly, const dem::StepRoom& room, const UniaxialRecord& record) const;

  CheckpointPolicy policy;
  dem::Belonging belonging;
  Stopwatch since_written;
};

}  // namespace virtual_tests
