#include "impact/missile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impact {
namespace {

constexpr double degree = std::numbers::pi / 180;
/// Directions that differ by less count as one: the formulas are fits that scatter by far more.
constexpr double aligned = 5;  // degrees

bool is_aligned(double cosine) { return std::abs(cosine) >= std::cos(aligned * degree); }

int main_axis(const Vec3& direction) {
  Vec3::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

/// How a missile meets a wall.
struct Front {
  double area = 0, perimeter = 0;  ///< of its section across the approach [m2, m]
  double nose_factor = 0;
  std::string misfit;  ///< why it has no such numbers
};

Front front_of(const Box& box, const Vec3& direction) {
  const int axis = main_axis(direction);
  if (!is_aligned(direction[axis])) return {0, 0, 0, "a box that strikes with an edge or a corner first"};
  const double a = 2 * box.half_size[(axis + 1) % 3], b = 2 * box.half_size[(axis + 2) % 3];
  return {a * b, 2 * (a + b), flat_nose, ""};
}

Front front_of(const Sphere& sphere, const Vec3& /*direction*/) {
  return {std::numbers::pi * sphere.radius * sphere.radius, 2 * std::numbers::pi * sphere.radius,
          spherical_nose, ""};
}

Front front_of(const Cylinder& cylinder, const Vec3& direction) {
  if (!is_aligned(direction.z())) return {0, 0, 0, "a cylinder that does not strike along its axis"};
  const bool nose_first = direction.z() > 0;
  return {std::numbers::pi * cylinder.radius * cylinder.radius, 2 * std::numbers::pi * cylinder.radius,
          nose_first && cylinder.nose == Nose::hemisphere ? hemispherical_nose : flat_nose, ""};
}

Front front_of(const Mesh& /*mesh*/, const Vec3& /*direction*/) {
  return {0, 0, 0, "a shape of triangles, which has no diameter"};
}

}  // namespace

Slab struck_slab(const Scene& scene) {
  const Vec3& direction = scene.approach.direction;
  const int axis = main_axis(direction);
  Slab slab;
  slab.outward = (direction[axis] > 0 ? -1.0 : 1.0) * Vec3::Unit(axis);
  slab.front = direction[axis] > 0 ? Vec3(Vec3::Zero()) : scene.size;
  slab.thickness = scene.size[axis];
  return slab;
}

FormulaCheck check_formulas(const Scene& scene) {
  FormulaCheck check;
  if (!scene.impactor) {
    check.misfit = "there is no impactor";
    return check;
  }
  const Vec3 direction = scene.approach.direction.normalized();
  const int axis = main_axis(direction);
  const double across = std::min(scene.size[(axis + 1) % 3], scene.size[(axis + 2) % 3]);
  const Vec3 in_body = scene.approach.orientation.conjugate() * direction;
  const Front front =
      std::visit([&](const auto& shape) { return front_of(shape, in_body); }, scene.impactor->shape);
  check.missile.diameter = 2 * std::sqrt(front.area / std::numbers::pi);
  check.perimeter_diameter = front.perimeter / std::numbers::pi;
  if (!(scene.approach.speed > 0))
    check.misfit = "the impactor is at rest";
  else if (!is_aligned(direction[axis]))
    check.misfit =
        fmt::format("they hold for a path along the wall's normal, to within {:.0f} degrees", aligned);
  else if (scene.size[axis] >= across)
    check.misfit = fmt::format("the structure is no wall: {:.3g} m thick along the path, {:.3g} m across",
                               scene.size[axis], across);
  else if (!front.misfit.empty())
    check.misfit = "they do not know " + front.misfit;
  else if (check.missile.diameter >= across)
    check.misfit = "the impactor is wider than the wall";
  else if (!(scene.compressive_strength > 0))
    check.misfit = "they need the concrete's compressive strength, which the case does not give";
  if (!check.misfit.empty()) return check;

  check.missile.mass = scene.impactor->body.mass;
  check.missile.velocity = scene.approach.speed * std::abs(direction[axis]);
  check.missile.compressive_strength = scene.compressive_strength;
  check.missile.density = scene.card.density;
  check.missile.thickness = scene.size[axis];
  check.missile.nose_factor = front.nose_factor;
  const std::string where = scene.inputs.empty() ? "the scene" : scene.inputs.front().file.string();
  check.ndrc = modified_ndrc(check.missile, where);
  if (front.nose_factor == flat_nose) {
    MissileCase missile = check.missile;
    missile.diameter = check.perimeter_diameter;
    check.cea_edf = cea_edf(missile, where);
  }
  return check;
}

}  // namespace impact
