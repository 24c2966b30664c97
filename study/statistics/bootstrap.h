// Confidence intervals by drawing the sample again from itself (Efron and Tibshirani, An Introduction to the
// Bootstrap, 1993, chapters 13 and 14).
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace study::statistics {

struct Interval {
  double low = 0, high = 0;  ///< in the statistic's unit; NaN if it could not be had
  double level = 0;          ///< confidence, 0 to 1
};

enum class IntervalKind {
  percentile,  ///< quantiles of the resampled statistic
  bca          ///< the same, shifted for its bias and skewness; better for means and deviations of few values
};

struct BootstrapOptions {
  std::size_t resamples = 4000;
  double level = 0.95;
  std::uint64_t seed = 1;  ///< of dem::Random: the same input gives the same bits
  IntervalKind kind = IntervalKind::bca;
};

using Statistic = std::function<double(std::span<const double> values)>;
/// Several statistics of one sample, given as the numbers of its rows (with repetitions).
using RowStatistics = std::function<std::vector<double>(std::span<const std::size_t> rows)>;

/// Interval of a statistic of `values`, independent draws of one distribution. From fewer than three values
/// nothing can be drawn: NaN. Throws std::invalid_argument for options out of range.
/// A sample of ten is a small one: the interval of a mean then holds it a few percent less often than it says.
Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                            const BootstrapOptions& options = {});

/// The same for rows 0 to count - 1 that stay together, all statistics from the same draws. Draws in which a
/// statistic is not finite are left out for that statistic; its interval is NaN if half of them are.
std::vector<Interval> bootstrap_rows(std::size_t count, const RowStatistics& statistics,
                                     const BootstrapOptions& options = {});

}  // namespace study::statistics
