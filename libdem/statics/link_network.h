// The link network as a linear elastic structure: six degrees of freedom an element, two springs a link.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"

namespace dem {

/// One link's springs about its geometry at rest.
struct LinkSpring {
  std::int32_t a = 0, b = 0;
  Vec3 normal;                                           ///< from a to b
  double arm_a = 0, arm_b = 0;                           ///< to the contact point P_c (Eq. 2) [m]
  double normal_stiffness = 0, shear_stiffness = 0;      ///< Kn, Ks [N/m]
  double rolling_stiffness = 0, twisting_stiffness = 0;  ///< between the rotations of its ends [N m/rad]
};

/// The stiffness matrix of unbroken links, never assembled: it is applied link by link, in their order.
struct LinkNetwork {
  std::size_t elements = 0;
  std::vector<LinkSpring> springs;

  /// Kn = normal_modulus * S_int / D_init, Ks = shear_ratio * Kn. Links roll and twist freely: in a law with
  /// moments that holds for those in tension.
  LinkNetwork(std::span<const Vec3> centres, std::span<const double> radii, std::span<const LinkGeometry> links,
              double normal_modulus, double shear_ratio);
  /// The stiffest that a law's links can be: all of them pressed, none yielding.
  LinkNetwork(std::span<const Vec3> centres, std::span<const double> radii, std::span<const LinkGeometry> links,
              const LinkLaw& law);

  /// force = K displacement; both 6 * elements: (ux, uy, uz, rx, ry, rz) by element [m, rad] -> [N, N m].
  void multiply(std::span<const double> displacement, std::span<double> force) const;
  /// Number of links at each element.
  std::vector<int> coordination() const;
};

}  // namespace dem
