// One sample of a new shape or size against many of a reference: is it one of them? And a trend over a size.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace study::statistics {

/// A single value against a reference sample of n values with mean m and deviation s:
/// t = (value - m) / (s sqrt(1 + 1/n)), n - 1 degrees. It asks for a normal scatter.
struct Outsider {
  double deviation = 0;  ///< value / m - 1 [-]
  double t = 0;
  double p = 0;  ///< two-sided
};
/// None if the reference has fewer than three values or does not scatter.
std::optional<Outsider> outsider(double value, std::span<const double> reference);

/// How far (share of the mean) a single value must lie from the reference's mean to stand out at that level:
/// what the test above cannot see. NaN where `outsider` gives none.
double smallest_visible_deviation(std::span<const double> reference, double level = 0.95);

/// Holm's (1979) p values for several questions asked at once, in their order: with each below 0.05 the chance
/// of a single false one is 5%. NaN stays NaN and does not count.
std::vector<double> holm(std::span<const double> p_values);

/// Straight line y = intercept + slope x by least squares.
struct Trend {
  double slope = 0, intercept = 0;
  double standard_error = 0;  ///< of the slope
  double p = 0;               ///< two-sided, of "the slope is 0"
  double r_squared = 0;
};
/// None for fewer than three points, equal x, or y on one line. Throws std::invalid_argument if the lengths
/// differ.
std::optional<Trend> trend(std::span<const double> x, std::span<const double> y);

}  // namespace study::statistics
