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

/// Where there are more targets than parameters, not all can be hit. One with a wide tolerance (a strain, a
/// curve) then only keeps the search inside it: a strength is not traded for a strain that is good enough
/// already.
Residual residual_of(const TargetResult& result, bool too_many) {
  const double off = misfit(result), allowed = result.target.tolerance;
  if (!too_many || allowed < 0.05) return {off, allowed, 0};
  // A quarter too low is farther in logarithms than a quarter too high: what is met must not count as missed.
  const double border = is_curve(result.target.quantity) ? allowed
                        : off < 0                        ? -std::log1p(-allowed)
                                                         : std::log1p(allowed);
  return {off, 0.2 * border, 0.9 * border};
}

/// What the fit expects of one target before it has measured: exponents of T (or of T * ratio(zeta) where both
/// are free), zeta, Co and zeta_s, read off sweeps of `spall test` on a 2,700-element box: a start, which the
/// fit corrects. Empty for a curve: that has to be measured. With moments fc no longer saturates in Co.
std::vector<double> expected_exponents(Quantity quantity, dem::LinkLawKind law) {
  const bool moments = law == dem::LinkLawKind::moment_transfer;
  switch (quantity) {
    case Quantity::tensile_strength:
      return {1, 0, 0, 0};
    case Quantity::tension_peak_strain:
      return {1, 0.65, 0, 0};
    case Quantity::fracture_energy:
      return {2, 0.5, 0, 0};
    case Quantity::compressive_strength:
      return moments ? std::vector<double>{0.3, 0.1, 0.6, 0.2} : std::vector<double>{0.9, 0.4, 0.1, 0};
    case Quantity::compression_peak_strain:
      return moments ? std::vector<double>{0.2, 0.1, 0.5, 0.25} : std::vector<double>{0.9, 0.4, 0.1, 0};
    default:
      return {};
  }
}

/// The place of a parameter among the exponents.
std::size_t exponent_of(const std::string& parameter) {
  return parameter == "T" ? 0 : parameter == "zeta" ? 1 : parameter == "Co" ? 2 : 3;
}

}  // namespace

double achieved(const Target& target, const RoundResult& round, const CalibrationCase& wanted) {
  switch (target.quantity) {
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
    case Quantity::laboratory: {
      const std::vector<TestSummary>& tests = round.laboratory[target.laboratory.test];
      double total = 0;
      for (const TestSummary& test : tests) total += test.measured[target.laboratory.quantity];
      return total / static_cast<double>(tests.size());
    }
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
                       (needs_compression(target.quantity) && !round.compression.empty()) ||
                       (target.quantity == Quantity::laboratory && !round.laboratory.empty());
    if (there) results.push_back({target, achieved(target, round, wanted)});
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
const ParameterSlot& slot_zeta_s() {
  static const ParameterSlot slot{"slip_softening", &dem::MaterialCard::slip_softening,
                                  &CalibrationCase::slip_softening};
  return slot;
}

std::vector<ParameterSlot> free_slots(const CalibrationCase& wanted) {
  std::vector<ParameterSlot> slots;
  for (const ParameterSlot& slot : {slot_T(), slot_zeta(), slot_Co(), slot_zeta_s()})
    if ((wanted.*slot.in_case).free) slots.push_back(slot);
  return slots;
}

double log_interpolate(const std::vector<std::pair<double, double>>& table, double at) {
  std::size_t k = 1;
  while (k + 1 < table.size() && at > table[k].first) ++k;
  const auto& [x0, y0] = table[k - 1];
  const auto& [x1, y1] = table[k];
  return y0 * std::pow(at / x0, std::log(y1 / y0) / std::log(x1 / x0));
}

double expected_strength_ratio(double zeta) {
  static const std::vector<std::pair<double, double>> table{{1, 0.68},  {2, 0.79},  {5, 1.0},  {8, 1.15},
                                                            {15, 1.46}, {25, 1.87}, {40, 2.34}};
  return log_interpolate(table, zeta);
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
  const auto place_of = [&](const char* parameter) {
    return static_cast<std::size_t>(std::find(report.fitted.begin(), report.fitted.end(), parameter) -
                                    report.fitted.begin());
  };
  const std::size_t T = place_of("T"), zeta = place_of("zeta");
  const bool steer = T < slots.size() && zeta < slots.size();
  if (steer) {
    parameters[T].value *= expected_strength_ratio(parameters[zeta].value);
    parameters[T].high *= 10;
  }
  const auto card_at = [&](std::vector<double> values) {
    if (steer) {
      const Parameter& bounds = wanted.tensile_strength;
      values[T] = std::clamp(values[T] / expected_strength_ratio(values[zeta]), bounds.low, bounds.high);
    }
    dem::MaterialCard made = card;
    for (std::size_t k = 0; k < slots.size(); ++k) made.*slots[k].in_card = values[k];
    return made;
  };
  int evaluation = 0;
  const auto residuals = [&](const std::vector<double>& values) {
    const dem::MaterialCard trial = card_at(values);
    StageStep step{name, ++evaluation, trial, compare(wanted, bench.run(trial, round)), 0};
    std::erase_if(step.targets, [&](const TargetResult& result) {
      return std::find(quantities.begin(), quantities.end(), result.target.quantity) == quantities.end();
    });
    const bool too_many = step.targets.size() > slots.size();
    std::vector<Residual> list;
    for (const TargetResult& result : step.targets) {
      step.worst = std::max(step.worst, std::abs(misfit(result)) / result.target.tolerance);
      list.push_back(residual_of(result, too_many));
    }
    if (watch) watch(step);
    return list;
  };
  Sensitivity expected;
  for (const Target& target : wanted.targets) {
    if (std::find(quantities.begin(), quantities.end(), target.quantity) == quantities.end()) continue;
    const std::vector<double> all = expected_exponents(target.quantity, card.link_law);
    expected.emplace_back();
    for (const std::string& parameter : report.fitted)
      if (!all.empty()) expected.back().push_back(all[exponent_of(parameter)]);
  }
  const MinimaxResult best = fit_minimax(parameters, residuals, expected, options);
  card = card_at(best.values);
  report.evaluations = best.evaluations;
  report.worst = best.worst;
  return report;
}

}  // namespace calibrate
