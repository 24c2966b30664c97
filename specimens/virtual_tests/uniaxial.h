// Uniaxial tension and compression, quasi-static, to past the peak.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "libdem/core/progress.h"
#include "libdem/drive/platens.h"
#include "libdem/material/material_card.h"
#include "libdem/probe/energy.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/checkpoint_policy.h"
#include "specimens/virtual_tests/curve.h"
#include "specimens/virtual_tests/final_fields.h"

namespace virtual_tests {

enum class Loading { tension, compression };
std::string_view name_of(Loading loading);

struct UniaxialOptions {
  Loading loading = Loading::tension;
  dem::EndCondition ends = dem::EndCondition::free;
  double platen_friction = 0.1;  ///< between rough platens and concrete [-]; counts where ends are rough
  int axis = -1;                 ///< 0, 1, 2; negative: the specimen's long axis
  double expected_strength =
      0;                ///< [Pa]; 0: guessed from the card. Sets the speed and the sampling, not the physics
  double velocity = 0;  ///< closing speed of the platens [m/s]; 0: from `rate`
  double rate = 0;  ///< speed over (wave speed * expected strength / E) [-]; 0: 0.03 tension, 0.01 compression
  double damping = 0.3;             ///< local damping
  double time_step_fraction = 0.7;  ///< of the critical time step
  double stop_at =
      0;  ///< ends when the stress has fallen to this part of the peak; 0: 0.15 tension, 0.6 compression
  double max_strain = 0;  ///< ends at this strain at the latest; 0: chosen from the expected strength
  int threads = 1;

  /// Throws InputError that names the option and its bound.
  void validate() const;
};

/// With the fields at the end.
struct UniaxialResult : FinalFields {
  Curve curve;
  double peak_stress = 0, peak_strain = 0;      ///< [Pa], between the platens [-]
  double young_modulus = 0, poisson_ratio = 0;  ///< from the curve, 10 to 33% of the peak
  double work_of_fracture = 0;  ///< per section area [J/m2]; whole only if the test ran to low stress
  std::size_t links = 0, broken_links = 0, contacts = 0;
  long steps = 0;
  double time_step = 0, critical_time_step = 0, velocity = 0;  ///< [s], [s], [m/s]
  int detector_rebuilds = 0;
  double unbalanced_force_ratio =
      0;  ///< largest difference of the platens' reactions over their mean, half peak to peak
  dem::EnergyLedger energy;                        ///< at the end
  double energy_balance_error = 0;                 ///< largest imbalance over the work of the platens
  bool passed_peak = false;                        ///< false: the strain limit came first
  double step_loop_seconds = 0, wall_seconds = 0;  ///< of all parts of a test that was stopped
  std::string state_sha256;

  double damage_ratio() const {
    return links == 0 ? 0 : static_cast<double>(broken_links) / static_cast<double>(links);
  }
  /// Quasi-static if the two platens agree within 5% up to the peak.
  bool quasi_static() const { return unbalanced_force_ratio <= 0.05; }
};

/// Runs the test. Throws InputError for a card, an option or a checkpoint that is not valid, RunError if it
/// diverges (NaN, with the step) or cannot write its checkpoint, Interrupted on a signal, after the step under
/// way and with a checkpoint if one is kept. A test that was stopped and goes on gives the bits of one that
/// was not, its seconds are the sum of the parts.
UniaxialResult run_uniaxial(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                            const UniaxialOptions& options, const dem::ProgressCallback& progress = {},
                            const CheckpointPolicy& checkpoint = {});

}  // namespace virtual_tests
