#include "impact/impactors/contact_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdem/core/error.h"

namespace impact {
namespace {

struct Normal {
  double force = 0, stored = 0, tangent = 0;  ///< tangent: dF/du [N/m]
};

Normal normal_spring(const ContactLaw& law, double radius, double overlap) {
  const double u = std::max(0.0, overlap);
  if (law.spring == NormalSpring::linear) {
    const double k = law.normal_stiffness(radius);
    return {k * u, 0.5 * k * u * u, k};
  }
  const double factor = 4.0 / 3 * law.modulus * std::sqrt(radius), root = std::sqrt(u);
  return {factor * u * root, 0.4 * factor * u * u * root, 1.5 * factor * root};
}

/// Turns v with the contact: about the normal by `twist`, then the shortest way from one normal to the next.
Vec3 carried(const Vec3& v, const Vec3& from, const Vec3& to, double twist) {
  const Vec3 turned = std::cos(twist) * v + std::sin(twist) * from.cross(v);
  const double cosine = from.dot(to);
  // Normals of neighbouring steps are near each other; where a dent makes them jump, keep the tangential part.
  if (cosine < 0.5) return turned - to.dot(turned) * to;
  const Vec3 axis = from.cross(to);
  const Vec3 swung = cosine * turned + axis.cross(turned) + axis.dot(turned) / (1 + cosine) * axis;
  return swung - to.dot(swung) * to;  // against the rounding of many steps
}

}  // namespace

void ContactLaw::validate(const std::string& where) const {
  const auto require = [&](bool holds, const char* what, double value, const char* allowed) {
    if (!holds) throw dem::InputError(where, fmt::format("the contact's {} is {}", what, value), allowed);
  };
  const bool given = stiffness.has_value() && spring == NormalSpring::linear;
  if (stiffness.has_value() && spring != NormalSpring::linear)
    throw dem::InputError(where, "the contact has a stiffness and a Hertzian spring",
                          "a stiffness belongs to the linear spring; Hertz takes a modulus");
  if (given)
    require(*stiffness > 0 && std::isfinite(*stiffness), "stiffness", *stiffness,
            "it must be positive, in N/m");
  else
    require(modulus > 0 && std::isfinite(modulus), "modulus", modulus, "it must be positive, in Pa");
  require(shear_ratio >= 0 && std::isfinite(shear_ratio), "shear ratio", shear_ratio, "it must be 0 or more");
  require(friction >= 0 && std::isfinite(friction), "friction", friction,
          "the tangent of the friction angle must be 0 or more");
  require(damping_ratio >= 0 && damping_ratio <= 1, "damping ratio", damping_ratio, "it must be from 0 to 1");
}

double ContactLaw::normal_stiffness(double radius) const {
  return stiffness ? *stiffness : modulus * std::numbers::pi * radius;
}

double ContactLaw::tangential_stiffness(double radius) const { return shear_ratio * normal_stiffness(radius); }

ContactForce evaluate(const ContactLaw& law, const ContactGeometry& geometry, double time_step,
                      ContactHistory& history) {
  const bool touching = geometry.overlap > 0;
  const double approach = -geometry.velocity.dot(geometry.middle_normal);
  const Normal spring = normal_spring(law, geometry.radius, geometry.overlap);
  ContactForce result;
  result.stored = spring.stored;

  double dashpot = 0;
  if (law.damping_ratio > 0 && touching)
    // The dashpot may not pull: all that it can do is take the spring's force away.
    dashpot = std::max(-spring.force,
                       2 * law.damping_ratio * std::sqrt(geometry.reduced_mass * spring.tangent) * approach);
  result.damped = 0.5 * (history.dashpot + dashpot) * approach * time_step;
  history.dashpot = dashpot;
  result.normal = spring.force + dashpot;

  const double stiffness = law.tangential_stiffness(geometry.radius);
  const double limit = touching ? law.friction * result.normal : 0;
  Vec3 shear = Vec3::Zero();
  if (stiffness > 0 && law.friction > 0) {
    const double twist = geometry.twist_rate * time_step;
    const Vec3 slip = geometry.velocity + approach * geometry.middle_normal;
    const Vec3 increment =
        carried(-stiffness * time_step * slip, geometry.middle_normal, geometry.normal, 0.5 * twist);
    shear = increment;
    if (!history.normal.isZero(0)) shear += carried(history.shear, history.normal, geometry.normal, twist);
    const double size = shear.norm();
    if (size > limit) {
      // Trapezoidal work of the mean force over the slip, as for links.
      const double keep = limit / size;
      result.sliding = 0.5 * (1 - keep) * ((1 + keep) * size * size - increment.dot(shear)) / stiffness;
      shear *= keep;
    }
    result.stored += 0.5 * shear.squaredNorm() / stiffness;
  }
  history.shear = shear;
  history.normal = geometry.normal;
  result.force = result.normal * geometry.normal + shear;
  return result;
}

}  // namespace impact
