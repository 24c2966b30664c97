#include "specimens/virtual_tests/expected_end.h"

#include <algorithm>
#include <cmath>

namespace virtual_tests {
namespace {

/// The first point at or after `strain`.
const CurvePoint& point_at(const Curve& curve, double strain) {
  const auto found = std::lower_bound(curve.begin(), curve.end() - 1, strain,
                                      [](const CurvePoint& p, double value) { return p.strain < value; });
  return *found;
}

/// 1 where the curve runs straight from the origin, 0 at its peak: tangent over secant, over the last tenth.
double steepness(const Curve& curve) {
  const CurvePoint& last = curve.back();
  const CurvePoint& before = point_at(curve, 0.9 * last.strain);
  const double way = last.strain - before.strain;
  if (!(way > 0) || !(last.stress > 0)) return 1;
  return std::clamp((last.stress - before.stress) / way * last.strain / last.stress, 0.0, 1.0);
}

}  // namespace

double expected_end(const Curve& curve, std::size_t peak_index, double first_guess, double stop_at,
                    double max_strain) {
  if (curve.empty()) return std::min(first_guess, max_strain);
  const CurvePoint &last = curve.back(), &peak = curve[peak_index];
  // No peak is less wide than this: what comes after a straight rise, and what comes after its top.
  double end = std::max(first_guess, (1.1 + 0.25 * steepness(curve)) * last.strain);
  if (last.stress > 0 && last.stress < 0.95 * peak.stress) {
    const CurvePoint& before = point_at(curve, 0.5 * (peak.strain + last.strain));
    const double rate = std::log(before.stress / last.stress) / (last.strain - before.strain);
    const double wanted = std::log(last.stress / (stop_at * peak.stress));
    if (rate > 0 && wanted > 0) end = last.strain + wanted / rate;
  }
  return std::clamp(end, last.strain, std::max(max_strain, last.strain));
}

}  // namespace virtual_tests
