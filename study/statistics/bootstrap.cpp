#include "study/statistics/bootstrap.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "libdem/core/random.h"
#include "study/statistics/summary.h"

namespace study::statistics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Share of the draws below the estimate, ties counted half, as a normal quantile: the bias z0.
double bias_quantile(std::span<const double> ascending, double estimate) {
  const auto [first, last] = std::equal_range(ascending.begin(), ascending.end(), estimate);
  const auto below = static_cast<double>(first - ascending.begin());
  const auto ties = static_cast<double>(last - first);
  return gsl_cdf_ugaussian_Pinv((below + 0.5 * ties) / static_cast<double>(ascending.size()));
}

/// From the statistic with one row left out in turn: its skewness over six, a of Efron's eq. 14.15.
double acceleration(const std::vector<double>& left_out) {
  const double mean =
      std::accumulate(left_out.begin(), left_out.end(), 0.0) / static_cast<double>(left_out.size());
  double squares = 0, cubes = 0;
  for (const double value : left_out) {
    const double distance = mean - value;
    squares += distance * distance, cubes += distance * distance * distance;
  }
  return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

Interval interval_of(std::vector<double> draws, double estimate, const std::vector<double>& left_out,
                     const BootstrapOptions& options) {
  std::erase_if(draws, [](double value) { return !std::isfinite(value); });
  if (!std::isfinite(estimate) || 2 * draws.size() <= options.resamples) return {nan, nan, options.level};
  std::ranges::sort(draws);
  double low = (1 - options.level) / 2, high = 1 - low;
  if (options.kind == IntervalKind::bca) {
    const double bias = bias_quantile(draws, estimate), a = acceleration(left_out);
    const auto shifted = [&](double share) {
      const double z = bias + gsl_cdf_ugaussian_Pinv(share);
      return gsl_cdf_ugaussian_P(bias + z / (1 - a * z));
    };
    // An estimate outside all its draws, or a row without which there is no statistic, leaves nothing to shift
    // by.
    if (std::isfinite(bias) && std::isfinite(a)) low = shifted(low), high = shifted(high);
  }
  return {quantile(draws, low), quantile(draws, high), options.level};
}

}  // namespace

std::vector<Interval> bootstrap_rows(std::size_t count, const RowStatistics& statistics,
                                     const BootstrapOptions& options) {
  if (!(options.level > 0 && options.level < 1))
    throw std::invalid_argument("bootstrap: the level must lie between 0 and 1");
  if (options.resamples < 100) throw std::invalid_argument("bootstrap: fewer than 100 resamples");
  std::vector<std::size_t> rows(count);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const std::vector<double> estimate = statistics(rows);
  const std::size_t wanted = estimate.size();
  if (count < 3) return std::vector<Interval>(wanted, Interval{nan, nan, options.level});

  std::vector<std::vector<double>> draws(wanted), left_out(wanted);
  const auto add = [&](std::vector<std::vector<double>>& lists) {
    const std::vector<double> drawn = statistics(rows);
    for (std::size_t k = 0; k < wanted; ++k) lists[k].push_back(drawn[k]);
  };
  dem::Random random(options.seed);
  for (std::size_t draw = 0; draw < options.resamples; ++draw) {
    for (std::size_t& row : rows) row = static_cast<std::size_t>(random.below(count));
    add(draws);
  }
  if (options.kind == IntervalKind::bca) {
    rows.resize(count - 1);
    for (std::size_t without = 0; without < count; ++without) {
      for (std::size_t k = 0; k + 1 < count; ++k) rows[k] = k < without ? k : k + 1;
      add(left_out);
    }
  }
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < wanted; ++k)
    intervals.push_back(interval_of(std::move(draws[k]), estimate[k], left_out[k], options));
  return intervals;
}

Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                            const BootstrapOptions& options) {
  std::vector<double> drawn;
  const RowStatistics one = [&](std::span<const std::size_t> rows) {
    drawn.clear();
    for (const std::size_t row : rows) drawn.push_back(values[row]);
    return std::vector<double>{drawn.empty() ? nan : statistic(drawn)};
  };
  return bootstrap_rows(values.size(), one, options).front();
}

}  // namespace study::statistics
