// What the stages of the strength fit share: parameters into a card, virtual tests into residuals.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "calibrate/minimax_fit.h"
#include "calibrate/target.h"
#include "calibrate/test_bench.h"

namespace calibrate {

/// Means over the specimens.
double achieved(const Target& target, const RoundResult& round, const CalibrationCase& wanted);

/// All targets that the round's tests speak to.
std::vector<TargetResult> compare(const CalibrationCase& wanted, const RoundResult& round);

/// One strength parameter of a card by its place in the case.
struct ParameterSlot {
  const char* name;  ///< as in card.toml
  double dem::MaterialCard::*in_card;
  Parameter CalibrationCase::*in_case;
};
const ParameterSlot& slot_T();
const ParameterSlot& slot_zeta();
const ParameterSlot& slot_Co();
const ParameterSlot& slot_zeta_s();
/// All of them that are free in the case.
std::vector<ParameterSlot> free_slots(const CalibrationCase& wanted);

/// Linear in the logarithms between the points of a table, extended at its ends.
double log_interpolate(const std::vector<std::pair<double, double>>& table, double at);

/// ft/T as it grows with zeta, measured on a 2,700-element box at nu = 0.2 (`spall test tension`). Only to
/// start and to steer the fit: where T and zeta are fitted together the search moves T * ratio(zeta), which ft
/// sees, and zeta, which fc and the tension's ductility see, instead of two parameters that undo each other.
double expected_strength_ratio(double zeta);

/// Called after each evaluation of a stage.
struct StageStep {
  std::string stage;
  int evaluation = 0;
  dem::MaterialCard card;
  std::vector<TargetResult> targets;
  double worst = 0;  ///< largest misfit over tolerance
};
using StageWatcher = std::function<void(const StageStep&)>;

/// Fits the free ones of `slots` to the targets of `round`, starting from `card`. Leaves the card at the best
/// point. Does nothing if no parameter is free or no target is there.
struct StageReport {
  std::string name;
  int evaluations = 0;
  double worst = 0;
  std::vector<std::string> fitted;
};
StageReport fit_stage(const std::string& name, const CalibrationCase& wanted, TestBench& bench,
                      dem::MaterialCard& card, std::vector<ParameterSlot> slots,
                      const std::vector<Quantity>& quantities, Round round, const MinimaxOptions& options,
                      const StageWatcher& watch);

}  // namespace calibrate
