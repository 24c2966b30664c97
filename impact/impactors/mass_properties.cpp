#include "impact/impactors/mass_properties.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "libdem/core/error.h"

namespace impact {
namespace {

using std::numbers::pi;

Filled filled_of(const Box& box) {
  const Vec3 size = 2 * box.half_size, square = size.cwiseProduct(size);
  const double volume = size.prod();
  const Vec3 diagonal(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  return {volume, Vec3::Zero(), (volume / 12 * diagonal).asDiagonal()};
}

Filled filled_of(const Sphere& sphere) {
  const double r = sphere.radius, volume = 4.0 / 3 * pi * r * r * r;
  return {volume, Vec3::Zero(), 0.4 * volume * r * r * Mat3::Identity()};
}

/// Volume of a cylinder's straight part and of its nose.
std::array<double, 2> cylinder_parts(double radius, double length, Nose nose) {
  if (nose == Nose::flat) return {pi * radius * radius * length, 0};
  return {pi * radius * radius * (length - radius), 2.0 / 3 * pi * radius * radius * radius};
}

Filled filled_of(const Cylinder& c) {
  const double r = c.radius, length = c.front - c.back;
  const double straight = c.nose == Nose::flat ? length : length - r;
  const auto [body, nose] = cylinder_parts(r, length, c.nose);
  // Steiner's theorem for each part. A hemisphere has 2/5 m r^2 about any axis through the sphere's centre, and
  // its own centre of mass 3/8 r in front of that.
  const double body_arm = c.back + 0.5 * straight, shoulder = c.back + straight,
               nose_arm = shoulder + 0.375 * r;
  const double across = body * (r * r / 4 + straight * straight / 12 + body_arm * body_arm) +
                        nose * ((0.4 - 0.375 * 0.375) * r * r + nose_arm * nose_arm);
  const double along = body * r * r / 2 + nose * 0.4 * r * r;
  return {body + nose, Vec3::Zero(), Vec3(across, across, along).asDiagonal()};
}

Filled filled_of(const Mesh& mesh) { return filled(*mesh.surface); }

MassProperties scaled(const Filled& shape, double density) {
  return {density * shape.volume, density * shape.inertia};
}

void require_positive(double value, const char* what, const char* unit, const std::string& where) {
  if (!(value > 0 && std::isfinite(value)))
    throw dem::InputError(where, fmt::format("the impactor's {} is {} {}", what, value, unit),
                          "it must be positive and finite");
}

}  // namespace

Filled filled(const Shape& shape) {
  return std::visit([](const auto& one) { return filled_of(one); }, shape);
}

Filled filled(const TriangleMesh& surface) {
  // Signed tetrahedra from one point to every triangle. That point is the middle of the bounding box: from far
  // away the differences would cancel. The second moment of a tetrahedron with one corner at the origin is
  // V/20 (sum of v v^T + s s^T) with s the sum of its corners (Tonon, J. Math. Stat. 1 (2005) 8).
  const Vec3 middle = surface.bounding_box().center();
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& triangle : surface.triangles()) {
    const Vec3 a = surface.vertices()[static_cast<std::size_t>(triangle[0])] - middle;
    const Vec3 b = surface.vertices()[static_cast<std::size_t>(triangle[1])] - middle;
    const Vec3 c = surface.vertices()[static_cast<std::size_t>(triangle[2])] - middle;
    const double part = a.dot(b.cross(c)) / 6;
    const Vec3 sum = a + b + c;
    volume += part;
    first += part / 4 * sum;
    second += part / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Vec3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  return {volume, middle + centre, second.trace() * Mat3::Identity() - second};
}

double cylinder_centre(double radius, double length, Nose nose) {
  if (nose == Nose::flat) return 0.5 * length;
  const auto [body, cap] = cylinder_parts(radius, length, nose);
  const double straight = length - radius;
  return (body * 0.5 * straight + cap * (straight + 0.375 * radius)) / (body + cap);
}

MassProperties from_density(const Shape& shape, double density, const std::string& where) {
  require_positive(density, "density", "kg/m3", where);
  return scaled(filled(shape), density);
}

MassProperties from_mass(const Shape& shape, double mass, const std::string& where) {
  require_positive(mass, "mass", "kg", where);
  const Filled unit = filled(shape);
  return {mass, mass / unit.volume * unit.inertia};
}

}  // namespace impact
