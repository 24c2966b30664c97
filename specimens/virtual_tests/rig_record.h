// What the driver of a laboratory test settles beforehand, and what it notes down while the test runs.
#pragma once
#include "libdem/probe/energy.h"
#include "libdem/run/checkpoint.h"
#include "libdem/run/step.h"
#include "specimens/virtual_tests/curve.h"
#include "specimens/virtual_tests/film.h"
#include "specimens/virtual_tests/rig.h"
#include "specimens/virtual_tests/stopwatch.h"

namespace virtual_tests {

/// Settled before the first step. The same inputs give the same plan: no checkpoint keeps it.
struct RigPlan {
  RigFacts facts;
  double velocity = 0;         ///< of the control, its unit per second
  double rise_time = 0;        ///< in which the elastic peak is reached [s]
  double elastic_control = 0;  ///< where it is reached
  double expected_force = 0;   ///< there [N]
  double stop_at = 0, furthest = 0;
  double critical_time_step = 0;  ///< [s]
  dem::StepOptions step;
  long half_window = 1;  ///< a window is 2 half_window + 1 steps

  long window_steps() const { return 2 * half_window + 1; }
};

/// Everything that changes from step to step besides the assembly and the rig's own numbers.
struct RigRecord {
  long steps = 0;
  CurveTable curve;
  Curve shape;  ///< the same curve as control and stress only, for what reads that
  // The window of steps under way.
  long window_steps = 0;
  double force = 0, opposing = 0;  ///< sums [N]
  double control = 0;              ///< at its middle
  std::vector<double> extra;       ///< at its middle
  double broken = 0;               ///< part of all links, from the last time it was counted

  dem::EnergyLedger ledger;
  double worst_imbalance = 0;  ///< of the ledger [J]
  double peak = 0;             ///< highest stress so far [Pa]
  std::size_t peak_index = 0;  ///< its place in the curve
  int rebuilds = 0;            ///< of the contact list, before a stop
  Film film;
  Stopwatch wall, loop;

  RigRecord(const RigFacts& facts, int pictures);
};

/// Books one step that moved everything as `sums` says and took `work` from outside [J].
void book_step(RigRecord& record, const RigPlan& plan, const Rig& rig, const dem::StepSums& sums, double work,
               const dem::Particles& particles);
bool window_is_full(const RigRecord& record, const RigPlan& plan);
/// Makes the window a row of the curve and begins the next one. Throws RunError if the test has diverged.
void close_window(RigRecord& record, const RigPlan& plan, dem::Assembly& assembly, const dem::StepRoom& room);
SoFar so_far(const RigRecord& record, const RigPlan& plan);
/// The outcome, once the test is over.
TestOutcome conclude(RigRecord&& record, const RigPlan& plan, const Rig& rig, dem::Assembly& assembly,
                     const dem::StepRoom& room);

/// Every number of the record, the rig's, and the forces where something is prescribed, which the next step's
/// work begins with; `rebuilds`: of the contact list since the last stop.
dem::NamedNumbers numbers_of(const RigRecord& record, Rig& rig, const dem::Particles& particles, int rebuilds);
/// Throws InputError that names `file` if a number is missing.
void set_from(RigRecord& record, Rig& rig, dem::Particles& particles, const dem::NamedNumbers& numbers,
              const std::filesystem::path& file);

}  // namespace virtual_tests
