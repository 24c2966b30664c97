// A structured mesh of a box, whole or around the zone that discrete elements fill.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "impact/fe/mesh.h"

namespace fe {

/// The box that discrete elements fill. Finite elements reach into it by `overlap_layers` from each face that
/// does not lie on the outer box's surface; deeper ones are left out.
struct DiscreteZone {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
  int overlap_layers = 3;                        ///< elements thick
};

struct BoxMeshOptions {
  Vec3 origin = Vec3::Zero();  ///< lowest corner [m]
  Vec3 size = Vec3::Zero();    ///< [m]
  std::array<int, 3> elements = {0, 0, 0};
  /// Where the planes between elements lie along an axis, both faces of the box included, ascending [m]. Empty:
  /// evenly.
  std::array<std::vector<double>, 3> planes;
  std::optional<DiscreteZone> zone;

  /// The place of plane `number`, from 0 to the number of elements along that axis [m].
  double plane(int axis, int number) const;

  /// Throws InputError that names the bound which is violated. The zone's faces must lie on planes between
  /// elements: the message names the nearest one.
  void validate() const;
};

/// Elements that are small in and at the zone and grow away from it.
struct Grading {
  int zone_elements = 0;  ///< of equal size between the zone's faces
  double growth = 1.25;   ///< an element over its neighbour nearer to the zone, at most
  double largest = 0;     ///< size of an element away from the zone, at most [m]; 0: no bound
};

/// Planes for BoxMeshOptions::planes along one axis of a box from `low` to `high` around a zone from `zone_low`
/// to `zone_high` [m]. On either side the fewest elements that keep to `growth` and `largest`, growing evenly.
/// Throws InputError that names the bound which is violated.
std::vector<double> graded_planes(double low, double high, double zone_low, double zone_high,
                                  const Grading& grading);

/// Brick elements, numbered with z fastest. Throws InputError (options).
Mesh box_mesh(const BoxMeshOptions& options);

}  // namespace fe
