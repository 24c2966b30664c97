#include "study/statistics/reference_test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "study/statistics/summary.h"

namespace study::statistics {
namespace {

double two_sided(double t, double degrees) { return 2 * gsl_cdf_tdist_Q(std::abs(t), degrees); }

/// Deviation of a single new value from the mean, given the reference's own.
double prediction_deviation(const Summary& reference) {
  return reference.standard_deviation * std::sqrt(1 + 1 / static_cast<double>(reference.count));
}

bool scatters(std::span<const double> reference) {
  return reference.size() >= 3 && summarise(reference).standard_deviation > 0;
}

}  // namespace

std::optional<Outsider> outsider(double value, std::span<const double> reference) {
  if (!scatters(reference) || !std::isfinite(value)) return std::nullopt;
  const Summary summary = summarise(reference);
  Outsider result;
  result.deviation = value / summary.mean - 1;
  result.t = (value - summary.mean) / prediction_deviation(summary);
  result.p = two_sided(result.t, static_cast<double>(summary.count - 1));
  return result;
}

double smallest_visible_deviation(std::span<const double> reference, double level) {
  if (!scatters(reference)) return std::numeric_limits<double>::quiet_NaN();
  const Summary summary = summarise(reference);
  return gsl_cdf_tdist_Pinv(0.5 + level / 2, static_cast<double>(summary.count - 1)) *
         prediction_deviation(summary) / std::abs(summary.mean);
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < p_values.size(); ++k)
    if (!std::isnan(p_values[k])) order.push_back(k);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return p_values[k]; });
  std::vector<double> adjusted(p_values.begin(), p_values.end());
  double largest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    largest = std::max(largest, static_cast<double>(order.size() - k) * p_values[order[k]]);
    adjusted[order[k]] = std::min(1.0, largest);
  }
  return adjusted;
}

std::optional<Trend> trend(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("trend: x and y differ in length");
  if (x.size() < 3) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(x);
  if (!(high > low)) return std::nullopt;
  Trend result;
  double c00 = 0, c01 = 0, c11 = 0, residual = 0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &result.intercept, &result.slope, &c00, &c01, &c11,
                 &residual);
  result.standard_error = std::sqrt(c11);
  const double deviation = summarise(y).standard_deviation;
  const double total = deviation * deviation * static_cast<double>(y.size() - 1);
  if (!(residual > 1e-24 * total)) return std::nullopt;
  result.r_squared = 1 - residual / total;
  result.p = two_sided(result.slope / result.standard_error, static_cast<double>(x.size() - 2));
  return result;
}

}  // namespace study::statistics
