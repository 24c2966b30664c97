// The slope of one column of a curve over another.
#pragma once
#include <span>

namespace virtual_tests {

/// Least squares of y over x; 0 with fewer than 3 points or where x does not vary.
double slope_of(std::span<const double> x, std::span<const double> y);

}  // namespace virtual_tests
