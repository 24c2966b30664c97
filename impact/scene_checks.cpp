#include "impact/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace impact {

double distance_past(const Shape& shape, const Approach& approach, const Vec3& low, const Vec3& high) {
  // Seen along the path, both are flat convex figures. The distance between those is the largest over all
  // directions of that between their two supporting lines.
  const Vec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const Vec3 first = approach.direction.unitOrthogonal(), second = approach.direction.cross(first);
  double largest = -std::numeric_limits<double>::infinity();
  constexpr int directions = 720;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    const Vec3 outward = std::cos(angle) * first + std::sin(angle) * second;
    const Vec3 towards = approach.orientation.conjugate() * Vec3(-outward);
    largest = std::max(largest, outward.dot(approach.aim - centre) - reach_along(shape, towards) -
                                    half.dot(outward.cwiseAbs()));
  }
  return largest;
}

}  // namespace impact
