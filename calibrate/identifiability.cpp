#include "calibrate/identifiability.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace calibrate {
namespace {

constexpr double determined_below =
    0.5;  // a parameter that may change by half within the tolerances is not determined

std::string remedy(const std::string& name) {
  if (name == "zeta")
    return "give the strain at the tension peak, the fracture energy or a tension curve past its peak, or fix "
           "zeta in the case";
  if (name == "Co")
    return "give the strain at the compression peak or a compression curve past its peak, a confined test, or "
           "fix Co in the case";
  if (name == "slip_softening")
    return "give the strain at the compression peak or a compression curve past its peak, or fix "
           "slip_softening in "
           "the case";
  return "give a tensile strength, or fix T in the case";
}

}  // namespace

bool Identifiability::all_determined() const {
  return std::all_of(parameters.begin(), parameters.end(),
                     [](const ParameterVerdict& p) { return p.determined; });
}

Identifiability assess(const CalibrationCase& wanted, TestBench& bench, const dem::MaterialCard& card,
                       double step) {
  Identifiability result;
  const std::vector<ParameterSlot> slots = free_slots(wanted);
  Round round;
  for (const Target& target : wanted.targets) {
    round.tension = round.tension || needs_tension(target.quantity);
    round.compression = round.compression || needs_compression(target.quantity);
    round.laboratory = round.laboratory || target.quantity == Quantity::laboratory;
    if (needs_tension(target.quantity) || needs_compression(target.quantity) ||
        target.quantity == Quantity::laboratory)
      result.quantities.push_back(target);
  }
  if (slots.empty()) return result;

  const auto rows = static_cast<Eigen::Index>(result.quantities.size());
  const auto columns = static_cast<Eigen::Index>(slots.size());
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(rows, columns);
  result.sensitivity.assign(result.quantities.size(), std::vector<double>(slots.size(), 0));
  for (std::size_t p = 0; p < slots.size(); ++p) {
    const Parameter& bounds = wanted.*slots[p].in_case;
    dem::MaterialCard low = card, high = card;
    low.*slots[p].in_card = std::max(bounds.low, card.*slots[p].in_card * std::exp(-step));
    high.*slots[p].in_card = std::min(bounds.high, card.*slots[p].in_card * std::exp(step));
    const double width = std::log(high.*slots[p].in_card / (low.*slots[p].in_card));
    const auto below = compare(wanted, bench.run(low, round)), above = compare(wanted, bench.run(high, round));
    for (std::size_t q = 0; q < result.quantities.size(); ++q) {
      const double change = (misfit(above[q]) - misfit(below[q])) / width;
      result.sensitivity[q][p] = change;
      scaled(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(p)) = change / above[q].target.tolerance;
    }
  }
  // A vague prior (a factor of e^5 either way) stands for "nothing is known" and keeps the matrix regular.
  const Eigen::MatrixXd information =
      scaled.transpose() * scaled + Eigen::MatrixXd::Identity(columns, columns) / 25;
  const Eigen::MatrixXd covariance = information.inverse();
  for (std::size_t p = 0; p < slots.size(); ++p) {
    const Parameter& bounds = wanted.*slots[p].in_case;
    const double value = card.*slots[p].in_card;
    ParameterVerdict verdict{slots[p].name,
                             std::sqrt(covariance(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p))),
                             false, value <= bounds.low * 1.001 || value >= bounds.high * 0.999, ""};
    verdict.determined = verdict.relative_uncertainty < determined_below && !verdict.at_bound;
    if (verdict.at_bound)
      verdict.remark = fmt::format("{} ran to its bound: no value inside it meets the targets; {}",
                                   verdict.name, remedy(verdict.name));
    else if (!verdict.determined)
      verdict.remark = fmt::format(
          "{} is not determined: changing it by a factor of {} stays within the targets' tolerances; {}",
          verdict.name,
          verdict.relative_uncertainty > std::log(10)
              ? std::string("ten or more")
              : fmt::format("{:.2g}", std::exp(verdict.relative_uncertainty)),
          remedy(verdict.name));
    result.parameters.push_back(verdict);
  }
  return result;
}

}  // namespace calibrate
