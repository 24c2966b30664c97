#include "specimens/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "libdem/core/sha256.h"

namespace specimens {

std::string_view name_of(Shape shape) { return shape == Shape::box ? "box" : "cylinder"; }

double Specimen::volume() const { return section(2) * size.z(); }

double Specimen::section(int axis) const {
  if (shape == Shape::cylinder && axis == 2) return std::numbers::pi / 4 * size.x() * size.x();
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}

double Specimen::element_size() const {
  return elements() == 0 ? 0 : std::cbrt(volume() / static_cast<double>(elements()));
}

double Specimen::depth(const Vec3& point) const {
  const double along_z = std::min(point.z(), size.z() - point.z());
  if (shape == Shape::cylinder) {
    const double radius = size.x() / 2;
    return std::min(along_z, radius - std::hypot(point.x() - radius, point.y() - radius));
  }
  return std::min({point.x(), size.x() - point.x(), point.y(), size.y() - point.y(), along_z});
}

int Specimen::long_axis() const {
  if (shape == Shape::cylinder) return 2;
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (size[axis] > size[longest]) longest = axis;
  return longest;
}

std::string Specimen::sha256() const {
  static_assert(sizeof(Link) == 16 && sizeof(Vec3) == 24, "hashed as bytes: no padding allowed");
  dem::Sha256 hash;
  const std::string_view name = name_of(shape);
  hash.add(name.data(), name.size());
  hash.add(size.data(), 3 * sizeof(double));
  hash.add(std::span<const Vec3>(centres));
  hash.add(std::span<const double>(radii));
  hash.add(std::span<const Link>(links));
  return hash.hex();
}

}  // namespace specimens
