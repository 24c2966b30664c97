// When a virtual test writes its checkpoint, and how it goes on from one.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "libdem/material/material_card.h"
#include "libdem/run/checkpoint.h"
#include "libdem/run/checkpoint_interval.h"
#include "specimens/virtual_tests/checkpoint_policy.h"

namespace virtual_tests {

/// SHA-256 of all that a test depends on in a card: its numbers and choices, not its name.
std::string sha256_of(const dem::MaterialCard& card);

/// Looks after each step whether it is time to write, or to stop.
class CheckpointKeeper {
 public:
  /// `belonging` is not used without a file.
  CheckpointKeeper(const CheckpointPolicy& policy, dem::Belonging belonging);

  /// The numbers of the checkpoint, if that is wanted and it is there; assembly and room are then as they were.
  /// Throws InputError if it does not fit.
  std::optional<dem::NamedNumbers> restore(dem::Assembly& assembly, dem::StepRoom& room) const;

  /// Writes a checkpoint with the numbers of `numbers()` when it is due. Throws Interrupted, after writing one,
  /// if a signal asked for a stop.
  void look(dem::Assembly& assembly, const dem::StepRoom& room, long steps,
            const std::function<dem::NamedNumbers()>& numbers);

  const CheckpointPolicy& policy() const { return wanted; }

 private:
  CheckpointPolicy wanted;
  dem::Belonging belongs_to;
  dem::CheckpointPace pace;
};

/// The column `name` of a checkpoint. Throws InputError that names `file` if it is not there, or has no number
/// and `may_be_empty` is false.
const std::vector<double>& column_of(const dem::NamedNumbers& numbers, const std::string& name,
                                     const std::filesystem::path& file, bool may_be_empty = false);

}  // namespace virtual_tests
