#include "study/statistics/summary.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace study::statistics {

std::vector<double> finite_of(std::span<const double> values) {
  std::vector<double> kept;
  for (const double value : values)
    if (std::isfinite(value)) kept.push_back(value);
  return kept;
}

Summary summarise(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("summarise: no values");
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("summarise: a value is not finite");
  Summary summary;
  summary.count = values.size();
  summary.mean = gsl_stats_mean(values.data(), 1, values.size());
  summary.standard_deviation = values.size() > 1 ? gsl_stats_sd_m(values.data(), 1, values.size(), summary.mean)
                                                 : std::numeric_limits<double>::quiet_NaN();
  gsl_stats_minmax(&summary.min, &summary.max, values.data(), 1, values.size());
  summary.spread = summary.mean != 0 ? (summary.max - summary.min) / std::abs(summary.mean)
                                     : std::numeric_limits<double>::quiet_NaN();
  return summary;
}

double quantile(std::span<const double> ascending, double share) {
  if (ascending.empty()) throw std::invalid_argument("quantile: no values");
  return gsl_stats_quantile_from_sorted_data(ascending.data(), 1, ascending.size(),
                                             std::clamp(share, 0.0, 1.0));
}

}  // namespace study::statistics
