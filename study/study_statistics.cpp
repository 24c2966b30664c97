#include "study/study_statistics.h"

#include <cmath>
#include <limits>

#include "study/statistics/sobol_indices.h"
#include "study/statistics/summary.h"
#include "study/study_statistics_parts.h"

namespace study {
namespace {

double mean_of(std::span<const double> values) { return statistics::summarise(values).mean; }
double deviation_of(std::span<const double> values) { return statistics::summarise(values).standard_deviation; }

/// A quantity at every setting of the design in the design's order, the mean over specimens; NaN where a test
/// is missing or failed.
std::vector<double> by_point(const Plan& plan, const RowTable& table, const Quantity& quantity) {
  std::vector<double> sums(plan.points.size(), 0.0);
  std::vector<std::size_t> counts(plan.points.size(), 0);
  for (const Row& row : table.rows)
    if (row.test == quantity.test) sums[row.point - 1] += row.number(quantity.key), ++counts[row.point - 1];
  for (std::size_t k = 0; k < sums.size(); ++k)
    sums[k] = counts[k] == plan.study.specimens.size() ? sums[k] / static_cast<double>(counts[k])
                                                       : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

Json sensitivity_json(const Plan& plan, const RowTable& table) {
  Json json;
  json["base_points"] = plan.study.points;
  json["ranges"] = Json::array();
  for (const Parameter& parameter : plan.study.parameters)
    json["ranges"].push_back({{"parameter", parameter.key},
                              {"from", parameter.from},
                              {"to", parameter.to},
                              {"spacing", parameter.logarithmic ? "logarithmic" : "linear"}});
  json["quantities"] = Json::object();
  for (const Quantity& quantity : quantities_of(plan.study)) {
    const statistics::SobolIndices indices =
        statistics::sobol_indices(plan.study.parameters.size(), by_point(plan, table, quantity));
    if (indices.base_points < 2) continue;
    Json entry{{"base_points", indices.base_points},
               {"mean", indices.mean},
               {"std", std::sqrt(indices.variance)},
               {"inputs", Json::array()}};
    for (std::size_t i = 0; i < indices.inputs.size(); ++i) {
      const statistics::SobolIndex& index = indices.inputs[i];
      entry["inputs"].push_back({{"parameter", plan.study.parameters[i].key},
                                 {"first", number_or_null(index.first)},
                                 {"first_interval", to_json(index.first_interval)},
                                 {"total", number_or_null(index.total)},
                                 {"total_interval", to_json(index.total_interval)}});
    }
    json["quantities"][quantity.name] = std::move(entry);
  }
  return json;
}

}  // namespace

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const statistics::Interval& interval) {
  return {number_or_null(interval.low), number_or_null(interval.high)};
}

Json statistics_json(const Plan& plan, const RowTable& table) {
  Json json;
  json["confidence"] = statistics::BootstrapOptions{}.level;
  const bool one_setting = plan.cards.size() == 1;
  json["quantities"] = Json::object();
  if (plan.study.design == DesignKind::factorial)
    for (const Quantity& quantity : quantities_of(plan.study)) {
      const Sample sample = sample_of(table, quantity);
      if (sample.values.size() < 2) continue;
      Json entry = Json::object();
      if (one_setting) {
        entry["mean_interval"] = to_json(statistics::bootstrap_interval(sample.values, mean_of));
        entry["std_interval"] = to_json(statistics::bootstrap_interval(sample.values, deviation_of));
      }
      entry.update(effects_json(plan, sample, one_setting));
      json["quantities"][quantity.name] = std::move(entry);
    }
  if (Json errors = card_errors_json(plan, table); !errors.empty()) json["card_errors"] = std::move(errors);
  if (Json fit = eq1_json(plan, table); !fit.empty()) json["eq1"] = std::move(fit);
  if (plan.study.sensitivity) json["sensitivity"] = sensitivity_json(plan, table);
  return json;
}

}  // namespace study
