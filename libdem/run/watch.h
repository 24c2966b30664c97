// Whether a run still is what it claims to be: numbers that are numbers, elements that do not jump, energy that
// does not come from nowhere.
#pragma once
#include <string_view>

#include "libdem/probe/energy.h"
#include "libdem/run/step.h"

namespace dem {

/// Energy that may appear without cause, over all that has passed through the ledger. The scheme itself keeps
/// the balance to a few thousandths.
inline constexpr double allowed_energy_growth = 0.1;

/// To be called after each step that `advance` has made; costs nothing while all is well. Throws RunError that
/// names the run, the step, the first element that went wrong, where it is, and the likely cause, if an
/// element's motion is no number or carries it farther in one step than its radius (contacts are not found that
/// fast).
void watch_motion(const Assembly& assembly, const StepRoom& room, const StepSums& sums, double time_step,
                  long step, std::string_view run);

/// To be called when the ledger is up to date. Throws RunError if energy has grown by more than
/// allowed_energy_growth.
void watch_energy(const EnergyLedger& ledger, long step, std::string_view run);

}  // namespace dem
