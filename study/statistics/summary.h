// What one column of numbers says of itself.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace study::statistics {

/// In the unit of the column.
struct Summary {
  std::size_t count = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< with count - 1 in the denominator; NaN for a single value
  double min = 0, max = 0;
  double spread = 0;  ///< (max - min) / |mean| [-]: the gap of the paper's Figs. 5 and 6; NaN if the mean is 0
};

/// Of finite values. Throws std::invalid_argument if there is none, or one is not finite.
Summary summarise(std::span<const double> values);

/// Those of `values` that are numbers, in their order: a failed test leaves NaN in its column.
std::vector<double> finite_of(std::span<const double> values);

/// The `share` (0 to 1) quantile of ascending values, linear between order statistics: definition 7 of Hyndman
/// and Fan (1996), which is R's default. Throws std::invalid_argument if there is none.
double quantile(std::span<const double> ascending, double share);

}  // namespace study::statistics
