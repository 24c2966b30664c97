#include "impact/coupling/zone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/error.h"

namespace coupling {

void Zone::validate() const {
  const char* where = "coupling zone";
  if (!(half_size.minCoeff() > 0) || !half_size.allFinite() || !centre.allFinite())
    throw dem::InputError(where,
                          fmt::format("its size is {:g} x {:g} x {:g} m", 2 * half_size.x(), 2 * half_size.y(),
                                      2 * half_size.z()),
                          "every side must be above 0");
  if (!((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-9) || !(axes.determinant() > 0))
    throw dem::InputError(where, "its axes are not three right-handed unit vectors square to each other",
                          "give a rotation");
  if (std::none_of(coupled.begin(), coupled.end(), [](bool face) { return face; }))
    throw dem::InputError(where, "no face is coupled", "finite elements must go on behind one face at least");
  if (!(thickness > 0) || !std::isfinite(thickness))
    throw dem::InputError(where, fmt::format("the overlap is {:g} m thick", thickness), "it must be above 0");
  if (!(least_weight > 0 && least_weight < 0.5))
    throw dem::InputError(where, fmt::format("the least weight is {:g}", least_weight),
                          "it must lie between 0 and 0.5, both excluded: masses must not vanish");
  for (int k = 0; k < 3; ++k) {
    const std::size_t face = 2 * static_cast<std::size_t>(k);
    const double taken = thickness * (static_cast<int>(coupled[face]) + static_cast<int>(coupled[face + 1]));
    if (taken >= 2 * half_size[k])
      throw dem::InputError(where,
                            fmt::format("overlaps of {:g} m leave nothing of its {:g} m along axis {}",
                                        thickness, 2 * half_size[k], k + 1),
                            "make the zone larger or the overlap thinner");
  }
}

double Zone::overlap_coordinate(const Vec3& point) const {
  const Vec3 local = axes.transpose() * (point - centre);
  double depth = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const std::size_t face = 2 * static_cast<std::size_t>(k);
    if (coupled[face]) depth = std::min(depth, half_size[k] + local[k]);
    if (coupled[face + 1]) depth = std::min(depth, half_size[k] - local[k]);
  }
  return 1 - depth / thickness;
}

double Zone::finite_weight(const Vec3& point) const {
  const double s = overlap_coordinate(point);
  return s >= 1 ? 1 : std::clamp(s, least_weight, 1 - least_weight);
}

double Zone::discrete_weight(const Vec3& point) const {
  const double s = overlap_coordinate(point);
  return s <= 0 ? 1 : 1 - std::clamp(s, least_weight, 1 - least_weight);
}

std::vector<fe::GaussWeights> finite_weights(const Zone& zone, const fe::Mesh& mesh) {
  std::vector<fe::GaussWeights> weights(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const fe::Corners corners = mesh.corners(e);
    for (std::size_t g = 0; g < 8; ++g)
      weights[e][g] = zone.finite_weight(fe::position(corners, fe::gauss_points()[g]));
  }
  return weights;
}

std::vector<double> discrete_weights(const Zone& zone, std::span<const Vec3> centres) {
  std::vector<double> weights;
  weights.reserve(centres.size());
  for (const Vec3& centre : centres) weights.push_back(zone.discrete_weight(centre));
  return weights;
}

void weigh_links(std::span<const double> weights, std::span<const std::int32_t> a,
                 std::span<const std::int32_t> b, std::span<double> area) {
  for (std::size_t k = 0; k < area.size(); ++k)
    area[k] *= std::min(weights[static_cast<std::size_t>(a[k])], weights[static_cast<std::size_t>(b[k])]);
}

}  // namespace coupling
