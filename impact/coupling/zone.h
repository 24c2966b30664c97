// The bridging domain: where discrete and finite elements overlap, and what each counts there (Eq. 5, Fig. 13).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "impact/fe/body.h"
#include "libdem/core/vector.h"

namespace coupling {
using dem::Mat3;
using dem::Vec3;

/// The box of any orientation that discrete elements fill. Behind its coupled faces finite elements go on; they
/// reach into it by `thickness`, and that layer is the overlap.
struct Zone {
  Vec3 centre = Vec3::Zero();     ///< [m]
  Vec3 half_size = Vec3::Zero();  ///< along its own axes [m]
  Mat3 axes = Mat3::Identity();   ///< its own axes, a unit vector a column
  /// Faces behind which finite elements go on: first axis low, high, second axis low, high, third axis low,
  /// high.
  std::array<bool, 6> coupled = {false, false, false, false, false, false};
  double thickness = 0;        ///< of the overlap, from a coupled face inwards [m]
  double least_weight = 0.02;  ///< e: neither side ever counts less [-]

  /// Throws InputError that names what is wrong: no coupled face, axes that are not square to each other, an
  /// overlap that leaves no room for discrete elements alone.
  void validate() const;
  /// s: 0 and below where there are discrete elements alone, 1 and above where there are finite elements alone,
  /// linear across the overlap; in an edge between two coupled faces the nearer face decides [-].
  double overlap_coordinate(const Vec3& point) const;
  /// What finite elements count at a point, a: s within [e, 1 - e], 1 outside the zone.
  double finite_weight(const Vec3& point) const;
  /// What discrete elements count at a point, b: 1 where they are alone, 1 - a in the overlap.
  double discrete_weight(const Vec3& point) const;
};

/// a at every element's Gauss points; it multiplies stiffness and mass there.
std::vector<fe::GaussWeights> finite_weights(const Zone& zone, const fe::Mesh& mesh);

/// b at every discrete element's centre; it multiplies the element's mass and inertia.
std::vector<double> discrete_weights(const Zone& zone, std::span<const Vec3> centres);

/// Multiplies the interaction area of pair k by the smaller weight of its elements a[k] and b[k], as the step's
/// forces do by themselves (dem::Particles::set_weight): the energy ledger goes by the area.
void weigh_links(std::span<const double> weights, std::span<const std::int32_t> a,
                 std::span<const std::int32_t> b, std::span<double> area);

}  // namespace coupling
