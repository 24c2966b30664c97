#include "calibrate/curve_misfit.h"

#include <algorithm>
#include <cmath>

namespace calibrate {
namespace {

/// Linear interpolation in points sorted by x; constant outside.
template <class X, class Y>
double interpolate(std::size_t count, X x, Y y, double at) {
  if (at <= x(0)) return x(0) > 0 ? y(0) * at / x(0) : y(0);
  if (at >= x(count - 1)) return y(count - 1);
  std::size_t low = 0, high = count - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (x(middle) <= at ? low : high) = middle;
  }
  const double t = (at - x(low)) / (x(high) - x(low));
  return y(low) + t * (y(high) - y(low));
}

}  // namespace

double curve_difference(const virtual_tests::Curve& curve, const lab::LabCurve& laboratory) {
  if (curve.empty() || laboratory.size() < 2) return 0;
  const auto top = std::max_element(laboratory.stress.begin(), laboratory.stress.end());
  const double peak = *top;
  auto last = static_cast<std::size_t>(top - laboratory.stress.begin());
  while (last + 1 < laboratory.size() && laboratory.stress[last + 1] > 0.6 * peak) ++last;
  const double end = laboratory.strain[last];
  const int steps = 200;
  double total = 0;
  for (int k = 1; k <= steps; ++k) {
    const double strain = end * k / steps;
    const double wanted = interpolate(
        laboratory.size(), [&](std::size_t i) { return laboratory.strain[i]; },
        [&](std::size_t i) { return laboratory.stress[i]; }, strain);
    const double got = interpolate(
        curve.size(), [&](std::size_t i) { return curve[i].strain; },
        [&](std::size_t i) { return curve[i].stress; }, strain);
    total += (got - wanted) * (got - wanted) / (peak * peak) / steps;
  }
  return std::sqrt(total);
}

}  // namespace calibrate
