#include "specimens/virtual_tests/slope.h"

#include <cstddef>

namespace virtual_tests {

double slope_of(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 3) return 0;
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mean_x += x[k] / n, mean_y += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k)
    xx += (x[k] - mean_x) * (x[k] - mean_x), xy += (x[k] - mean_x) * (y[k] - mean_y);
  return xx > 0 ? xy / xx : 0;
}

}  // namespace virtual_tests
