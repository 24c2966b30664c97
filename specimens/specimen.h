// A specimen: where the elements are, which of them are linked, and the shape that it stands for.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/state/links.h"

namespace specimens {
using dem::Vec3;

/// box: size = its three sides. cylinder: size = {diameter, diameter, length}, axis along z.
/// Both fill [0, size] in x, y, z.
enum class Shape { box, cylinder };
std::string_view name_of(Shape shape);

/// Two linked elements (numbers, a < b) and the distance of their centres at rest, D_init [m].
using Link = dem::LinkGeometry;

/// A numerical specimen. Elements are numbered along a space-filling curve; links are sorted by (a, b).
struct Specimen {
  Shape shape = Shape::box;
  Vec3 size = Vec3::Zero();              ///< [m]
  std::uint64_t seed = 0;                ///< of the packing
  double interaction_radius_factor = 0;  ///< a link joins two elements if D_init <= factor * (Ra + Rb)
  std::vector<Vec3> centres;             ///< [m], one per element
  std::vector<double> radii;             ///< [m], one per element
  std::vector<Link> links;
  std::string origin;  ///< in words: how it was made ("packed", "extracted from slab.h5 ...")

  std::size_t elements() const { return centres.size(); }
  /// Volume of the nominal shape [m3].
  double volume() const;
  /// Area of the nominal section across `axis` (0, 1, 2) [m2]; for a cylinder only axis 2 is meaningful.
  double section(int axis) const;
  /// The characteristic size of an element: (volume / elements)^(1/3) [m]. About the mean diameter in the dense
  /// packing.
  double element_size() const;
  /// Distance from `point` to the nearest face of the nominal shape [m], negative outside.
  double depth(const Vec3& point) const;
  /// The axis along which a uniaxial test loads it by default: a cylinder's own; a box's longest side, the
  /// first of equals.
  int long_axis() const;
  /// SHA-256 over shape, size, centres, radii and links.
  std::string sha256() const;
};

}  // namespace specimens
