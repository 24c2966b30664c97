#include "calibrate/strength_stage.h"

#include <algorithm>
#include <cmath>

#include "calibrate/curve_misfit.h"

namespace calibrate {
namespace {

template <class Member>
double mean(const std::vector<TestSummary>& tests, Member member) {
  double total = 0;
  for (const TestSummary& test : tests) total += test.*member;
  return tests.empty() ? 0 : total / static_cast<double>(tests.size());
}

double mean_difference(const std::vector<TestSummary>& tests, const std::optional<lab::Series>& series) {
  if (!series || tests.empty()) return 0;
  double total = 0;
  for (const TestSummary& test : tests) total += curve_difference(test.curve, series->mean);
  return total / static_cast<double>(tests.size());
}

}  // namespace

double achieved(Quantity quantity, const RoundResult& round, const CalibrationCase& wanted) {
  switch (quantity) {
    case Quantity::tensile_strength:
      return mean(round.tension, &TestSummary::peak_stress);
    case Quantity::tension_peak_strain:
      return mean(round.tension, &TestSummary::peak_strain);
    case Quantity::fracture_energy:
      return mean(round.tension, &TestSummary::work_of_fracture);
    case Quantity::compressive_strength:
      return mean(round.compression, &TestSummary::peak_stress);
    case Quantity::compression_peak_strain:
      return mean(round.compression, &TestSummary::peak_strain);
    case Quantity::tension_curve:
      return mean_difference(round.tension, wanted.tension_series);
    case Quantity::compression_curve:
      return mean_difference(round.compression, wanted.compression_series);
    case Quantity::young_modulus:
    case Quantity::poisson_ratio:
      break;  // of the elastic stage
  }
  return 0;
}

std::vector<TargetResult> compare(const CalibrationCase& wanted, const RoundResult& round) {
  std::vector<TargetResult> results;
  for (const Target& target : wanted.targets) {
    const bool there = (needs_tension(target.quantity) && !round.tension.empty()) ||
                       (needs_compression(target.quantity) && !round.compression.empty());
    if (there) results.push_back({target, achieved(target.quantity, round, wanted)});
  }
  return results;
}

const ParameterSlot& slot_T() {
  static const ParameterSlot slot{"T", &dem::MaterialCard::tensile_strength,
                                  &CalibrationCase::tensile_strength};
  return slot;
}
const ParameterSlot& slot_zeta() {
  static const ParameterSlot slot{"zeta", &dem::MaterialCard::softening, &CalibrationCase::softening};
  return slot;
}
const ParameterSlot& slot_Co() {
  static const ParameterSlot slot{"Co", &dem::MaterialCard::cohesion, &CalibrationCase::cohesion};
  return slot;
}

StageReport fit_stage(const std::string& name, const CalibrationCase& wanted, TestBench& bench,
                      dem::MaterialCard& card, std::vector<ParameterSlot> slots,
                      const std::vector<Quantity>& quantities, Round round, const MinimaxOptions& options,
                      const StageWatcher& watch) {
  StageReport report{name, 0, 0, {}};
  std::erase_if(slots, [&](const ParameterSlot& slot) { return !(wanted.*slot.in_case).free; });
  const bool aimed = std::any_of(quantities.begin(), quantities.end(),
                                 [&](Quantity q) { return wanted.target(q) != nullptr; });
  if (slots.empty() || !aimed) return report;

  std::vector<FitParameter> parameters;
  for (const ParameterSlot& slot : slots) {
    const Parameter& p = wanted.*slot.in_case;
    parameters.push_back({slot.name, card.*slot.in_card, p.low, p.high});
    report.fitted.emplace_back(slot.name);
  }
  int evaluation = 0;
  const auto residuals = [&](const std::vector<double>& values) {
    dem::MaterialCard trial = card;
    for (std::size_t k = 0; k < slots.size(); ++k) trial.*slots[k].in_card = values[k];
    StageStep step{name, ++evaluation, trial, compare(wanted, bench.run(trial, round)), 0};
    std::vector<double> list;
    for (const TargetResult& result : step.targets) {
      if (std::find(quantities.begin(), quantities.end(), result.target.quantity) == quantities.end()) continue;
      list.push_back(misfit(result) / result.target.tolerance);
      step.worst = std::max(step.worst, std::abs(list.back()));
    }
    if (watch) watch(step);
    return list;
  };
  const MinimaxResult best = fit_minimax(parameters, residuals, options);
  for (std::size_t k = 0; k < slots.size(); ++k) card.*slots[k].in_card = best.values[k];
  report.evaluations = best.evaluations;
  report.worst = best.worst;
  return report;
}

}  // namespace calibrate
