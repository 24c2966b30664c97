// A structured mesh of a box, whole or around the zone that discrete elements fill.
#pragma once
#include <array>
#include <optional>

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
  std::optional<DiscreteZone> zone;

  /// Throws InputError that names the bound which is violated. The zone's faces must lie on planes between
  /// elements: the message names the nearest one.
  void validate() const;
};

/// Brick elements, numbered with z fastest. Throws InputError (options).
Mesh box_mesh(const BoxMeshOptions& options);

}  // namespace fe
