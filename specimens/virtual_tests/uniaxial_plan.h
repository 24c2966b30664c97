// What is settled before the first step of a uniaxial test and stays as it is.
#pragma once
#include "libdem/drive/platens.h"
#include "libdem/probe/strain_gauge.h"
#include "libdem/run/step.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace virtual_tests {

/// The options, settled for one specimen and card. The same inputs give the same plan: no checkpoint keeps it.
struct UniaxialPlan {
  Loading loading;
  int axis;
  double sign;                ///< of the platens' closing speed: 1 in compression, -1 in tension
  double expected_strength;   ///< [Pa]
  double likely_end;          ///< strain at which the test will end, a first guess [-]
  double velocity;            ///< of the platens towards each other, or apart [m/s]
  double stop_at;             ///< part of the peak stress [-]
  double least_peak;          ///< a stress below this is no peak yet [Pa]
  double max_strain;          ///< [-]
  double section;             ///< nominal, across the axis [m2]
  double strain_rate;         ///< between the platens [1/s]
  double critical_time_step;  ///< [s]
  dem::StepOptions step;
  long half_window;  ///< a window is 2 half_window + 1 steps
  dem::Platens platens;
  dem::StrainGauge gauge;

  long window_steps() const { return 2 * half_window + 1; }
  /// Strain between the platens after `steps` steps [-].
  double strain_after(long steps) const { return strain_rate * step.time_step * static_cast<double>(steps); }
};

/// `assembly` is at rest. Throws InputError if the specimen is too small for the test or the axis is wrong.
UniaxialPlan make_plan(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                       const UniaxialOptions& options, const dem::Assembly& assembly);

}  // namespace virtual_tests
