// What a uniaxial test notes down while it runs: sums over windows of steps, the curve, the energy ledger.
#pragma once
#include "libdem/drive/platen_friction.h"
#include "libdem/probe/energy.h"
#include "libdem/run/step.h"
#include "specimens/virtual_tests/curve.h"
#include "specimens/virtual_tests/film.h"
#include "specimens/virtual_tests/stopwatch.h"
#include "specimens/virtual_tests/uniaxial_plan.h"

namespace virtual_tests {

/// Everything that changes from step to step besides the assembly: what a checkpoint must keep.
struct UniaxialRecord {
  long steps = 0;
  Curve curve;
  // The window of steps under way.
  long window_steps = 0;
  double low = 0, high = 0;  ///< sums of the platens' reactions [N]
  CurvePoint point;          ///< what is known of its point; `broken` stays from the last time it was counted

  dem::PlatenFriction friction;  ///< between rough platens and their layers
  dem::EnergyLedger ledger;
  double friction_work = 0;      ///< of the platens' friction, as booked [J]
  double previous_reaction = 0;  ///< of the last step [N]
  double worst_imbalance = 0;    ///< of the ledger [J]
  double peak = 0;               ///< highest stress so far [Pa]
  std::size_t peak_index = 0;    ///< its place in the curve
  int rebuilds = 0;              ///< of the contact list, before a stop
  Film film;
  Stopwatch wall, loop;
};

/// Books one step: work and dissipation, the platens' reactions, the gauge at the window's middle.
void book_step(UniaxialRecord& record, const UniaxialPlan& plan, const dem::StepSums& sums,
               const dem::Particles& particles);

/// Whether the window under way has all its steps.
bool window_is_full(const UniaxialRecord& record, const UniaxialPlan& plan);

/// Makes the window a point of the curve and begins the next one. Throws RunError if the test has diverged.
void close_window(UniaxialRecord& record, const UniaxialPlan& plan, dem::Assembly& assembly,
                  const dem::StepRoom& room);

/// Whether the stress has fallen far enough below its peak.
bool has_fallen(const UniaxialRecord& record, const UniaxialPlan& plan);

/// Whether the last point ends the test: the stress has fallen, or the strain limit is reached.
bool is_over(const UniaxialRecord& record, const UniaxialPlan& plan);

/// The result, once the test is over.
UniaxialResult conclude(UniaxialRecord&& record, const UniaxialPlan& plan, dem::Assembly& assembly,
                        const dem::StepRoom& room);

}  // namespace virtual_tests
