// A spalling bar (Hopkinson): a compressive pulse runs through a bar, its free far end turns it into tension.
#pragma once
#include <string>

#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/checkpoint_policy.h"
#include "specimens/virtual_tests/outcome.h"

namespace virtual_tests {

enum class PulseShape { half_sine, trapezoid };

struct SpallingOptions {
  int axis = -1;  ///< 0, 1, 2; negative: the specimen's long axis
  PulseShape pulse = PulseShape::half_sine;
  double incident_stress = 0;       ///< peak of the pulse [Pa]; 0: four times the card's T
  double velocity = 0;              ///< peak of the struck end's velocity [m/s]; 0: from the incident stress
  double duration = 0;              ///< of the pulse [s]; 0: sound's time through 0.4 of the bar
  double rise = 0.25;               ///< of a trapezoid, part of its duration; it falls as long
  double static_strength = 0;       ///< that the dynamic increase factor refers to [Pa]; 0: none is given
  double end_time = 0;              ///< [s]; 0: three times sound's time through the bar
  double time_step_fraction = 0.7;  ///< of the critical time step
  int threads = 1;

  /// Throws InputError that names the option and its bound.
  void validate() const;
};

/// The elements within an element size of the low end follow the pulse's velocity along the axis, sideways they
/// are free; when the pulse is over they are let go, as an input bar parts from the specimen. Nothing is
/// damped.
///
/// Measured over slices an element thick: the speed of the pulse between a quarter and a half of the bar, its
/// stress rho c v there, the tension that comes back, the free end's velocity and by how much it is pulled back
/// before it rises again; from that the spall strength rho c dv / 2 (Novikov et al. 1966). Beside it, without
/// any wave theory: the tension across the section that broke, from the momentum of all that lies beyond it.
///
/// Throws InputError for an option, a bar too short for its pulse or a checkpoint that does not fit, RunError
/// if the run diverges, Interrupted on a signal, with a checkpoint if one is kept. The same bits on any number
/// of threads, and whether it was stopped or not.
TestOutcome run_spalling(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                         const SpallingOptions& options, const std::string& sha256_of_options,
                         const dem::ProgressCallback& progress = {}, const CheckpointPolicy& checkpoint = {});

/// Throws InputError where the bar is too short, or the pulse too long or too short for it.
void check_spalling(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                    const SpallingOptions& options);

}  // namespace virtual_tests
