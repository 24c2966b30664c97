#include "impact/impactors/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "impact/impactors/mass_properties.h"
#include "libdem/core/error.h"

namespace impact {
namespace {

void require_positive(double value, const char* what, const std::string& where) {
  if (!(value > 0 && std::isfinite(value)))
    throw dem::InputError(where, fmt::format("the impactor's {} is {} m", what, value),
                          "it must be positive and finite");
}

Nearest nearest_of(const Box& box, const Vec3& p) {
  const Vec3 clamped = p.cwiseMax(-box.half_size).cwiseMin(box.half_size);
  const Vec3 out = p - clamped;
  const double distance = out.norm();
  if (distance > 0) return {distance, clamped, out / distance};
  // Inside or on the surface: the nearest face; of equally near ones the first axis, the positive side.
  int axis = 0;
  const Vec3 depth = box.half_size - p.cwiseAbs();
  for (int k = 1; k < 3; ++k)
    if (depth[k] < depth[axis]) axis = k;
  const double side = p[axis] < 0 ? -1 : 1;
  Nearest result{-depth[axis], p, side * Vec3::Unit(axis)};
  result.point[axis] = side * box.half_size[axis];
  return result;
}

Nearest nearest_of(const Sphere& sphere, const Vec3& p) {
  const double radius = p.norm();
  const Vec3 normal = radius > 0 ? Vec3(p / radius) : Vec3::UnitZ();
  return {radius - sphere.radius, sphere.radius * normal, normal};
}

/// In the half plane (rho, z): distance, nearest point and normal.
struct PlaneNearest {
  double distance, rho, z, normal_rho, normal_z;
};

PlaneNearest nearest_in_plane(const Cylinder& c, double rho, double z) {
  const double shoulder = c.nose == Nose::hemisphere ? c.front - c.radius : c.front;
  if (c.nose == Nose::hemisphere && z > shoulder) {
    const double up = z - shoulder, reach = std::hypot(rho, up), depth = c.radius - reach;
    // Of a short one the back may be nearer than the nose.
    if (depth <= z - c.back) {
      const double nr = rho / reach, nz = up / reach;
      return {-depth, c.radius * nr, shoulder + c.radius * nz, nr, nz};
    }
    return {c.back - z, rho, c.back, 0, -1};
  }
  const double near_rho = std::min(rho, c.radius), near_z = std::clamp(z, c.back, shoulder);
  const double out_rho = rho - near_rho, out_z = z - near_z, distance = std::hypot(out_rho, out_z);
  if (distance > 0) return {distance, near_rho, near_z, out_rho / distance, out_z / distance};
  const double side = c.radius - rho, back = z - c.back;
  // A hemisphere has no front face: nearest to points behind its shoulder is never the nose.
  const bool flat = c.nose == Nose::flat;
  const double front = shoulder - z;
  if (flat && front <= side && front <= back) return {-front, rho, shoulder, 0, 1};
  if (back < side) return {-back, rho, c.back, 0, -1};
  return {-side, c.radius, z, 1, 0};
}

Nearest nearest_of(const Cylinder& cylinder, const Vec3& p) {
  const double rho = std::hypot(p.x(), p.y());
  const Vec3 radial = rho > 0 ? Vec3(p.x() / rho, p.y() / rho, 0) : Vec3::UnitX();
  const PlaneNearest q = nearest_in_plane(cylinder, rho, p.z());
  return {q.distance, q.rho * radial + Vec3(0, 0, q.z), q.normal_rho * radial + Vec3(0, 0, q.normal_z)};
}

Nearest nearest_of(const Mesh& mesh, const Vec3& p) { return mesh.surface->nearest(p); }

Eigen::AlignedBox3d box_of(const Box& box) { return {Vec3(-box.half_size), box.half_size}; }
Eigen::AlignedBox3d box_of(const Sphere& s) {
  return {Vec3(Vec3::Constant(-s.radius)), Vec3(Vec3::Constant(s.radius))};
}
Eigen::AlignedBox3d box_of(const Cylinder& c) {
  return {Vec3(-c.radius, -c.radius, c.back), Vec3(c.radius, c.radius, c.front)};
}
Eigen::AlignedBox3d box_of(const Mesh& mesh) { return mesh.surface->bounding_box(); }

double reach_of(const Box& box, const Vec3& n) { return box.half_size.dot(n.cwiseAbs()); }
double reach_of(const Sphere& sphere, const Vec3&) { return sphere.radius; }
double reach_of(const Cylinder& c, const Vec3& n) {
  const double rim = c.radius * std::hypot(n.x(), n.y());
  if (c.nose == Nose::flat) return rim + std::max(c.back * n.z(), c.front * n.z());
  return std::max(rim + c.back * n.z(), c.radius + (c.front - c.radius) * n.z());
}
double reach_of(const Mesh& mesh, const Vec3& n) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : mesh.surface->vertices()) farthest = std::max(farthest, p.dot(n));
  return farthest;
}

}  // namespace

Box make_box(const Vec3& size, const std::string& where) {
  for (int k = 0; k < 3; ++k) require_positive(size[k], "size", where);
  return {0.5 * size};
}

Sphere make_sphere(double diameter, const std::string& where) {
  require_positive(diameter, "diameter", where);
  return {0.5 * diameter};
}

Cylinder make_cylinder(double diameter, double length, Nose nose, const std::string& where) {
  require_positive(diameter, "diameter", where);
  require_positive(length, "length", where);
  const double radius = 0.5 * diameter;
  if (nose == Nose::hemisphere && length < radius)
    throw dem::InputError(
        where, fmt::format("a length of {} m is less than the nose's radius of {} m", length, radius),
        "length counts the hemispherical nose in");
  const double centre = cylinder_centre(radius, length, nose);
  return {radius, -centre, length - centre, nose};
}

Mesh make_mesh(TriangleMesh surface) {
  surface.translate(-filled(surface).centre);
  return {std::make_shared<const TriangleMesh>(std::move(surface))};
}

Nearest nearest(const Shape& shape, const Vec3& point) {
  return std::visit([&](const auto& one) { return nearest_of(one, point); }, shape);
}

Eigen::AlignedBox3d bounding_box(const Shape& shape) {
  return std::visit([](const auto& one) { return box_of(one); }, shape);
}

double reach_along(const Shape& shape, const Vec3& direction) {
  return std::visit([&](const auto& one) { return reach_of(one, direction); }, shape);
}

Eigen::Quaterniond leading(Lead lead, const Vec3& half_size, const Vec3& direction) {
  Vec3 from = Vec3::UnitZ();
  if (lead == Lead::edge) from = {0, half_size.y(), half_size.z()};
  if (lead == Lead::corner) from = half_size;
  return Eigen::Quaterniond::FromTwoVectors(from, direction).normalized();
}

}  // namespace impact
