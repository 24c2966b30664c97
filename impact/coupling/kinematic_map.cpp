#include "impact/coupling/kinematic_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "impact/fe/locator.h"
#include "libdem/core/error.h"

namespace coupling {
namespace {

/// Finite elements must go on behind every coupled face, and must not fill what discrete elements have alone.
void check_surrounds(const Zone& zone, const fe::Mesh& mesh, const fe::Locator& locator) {
  constexpr int samples = 5;
  for (int face = 0; face < 6; ++face) {
    if (!zone.coupled[static_cast<std::size_t>(face)]) continue;
    const int axis = face / 2, second = (axis + 1) % 3, third = (axis + 2) % 3;
    for (int i = 0; i < samples; ++i)
      for (int j = 0; j < samples; ++j) {
        Vec3 local;
        local[axis] = (face % 2 == 0 ? -1 : 1) * (zone.half_size[axis] + 1e-3 * zone.thickness);
        local[second] = zone.half_size[second] * (2 * (i + 0.5) / samples - 1);
        local[third] = zone.half_size[third] * (2 * (j + 0.5) / samples - 1);
        const Vec3 x = zone.centre + zone.axes * local;
        if (!locator.find(x))
          throw dem::InputError(
              mesh.origin,
              fmt::format("no finite element lies behind the zone's coupled face at ({:.4g}, {:.4g}, {:.4g}) m",
                          x.x(), x.y(), x.z()),
              "the mesh must surround the zone of discrete elements");
      }
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double farthest = -1;
    for (const std::int32_t node : mesh.elements[e])
      farthest = std::max(farthest, zone.overlap_coordinate(mesh.nodes[static_cast<std::size_t>(node)]));
    if (farthest <= 1e-6)
      throw dem::InputError(
          mesh.origin,
          fmt::format("element {} lies where there are discrete elements alone", mesh.element_tag(e)),
          "cut the zone out of the mesh, less the overlap");
  }
}

struct TiedElement {
  std::int32_t element = 0;
  fe::PointInMesh place;
};

std::vector<TiedElement> find_tied(const Zone& zone, const fe::Mesh& mesh, const fe::Locator& locator,
                                   std::span<const Vec3> centres) {
  std::vector<TiedElement> tied;
  std::size_t outside = 0, first_outside = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (zone.overlap_coordinate(centres[i]) <= 0) continue;
    if (const auto place = locator.find(centres[i], 1e-6)) {
      tied.push_back({static_cast<std::int32_t>(i), *place});
    } else if (outside++ == 0) {
      first_outside = i;
    }
  }
  if (outside > 0) {
    const Vec3& x = centres[first_outside];
    throw dem::InputError(
        mesh.origin,
        fmt::format("{} discrete elements of the overlap lie in no finite element, the first at ({:.4g}, "
                    "{:.4g}, {:.4g}) m",
                    outside, x.x(), x.y(), x.z()),
        "the mesh must surround the zone of discrete elements and reach into it by the whole overlap");
  }
  if (tied.empty())
    throw dem::InputError(mesh.origin, "no discrete element lies in the overlap",
                          "the zone must be filled with discrete elements and the overlap be thicker than one");
  std::stable_sort(tied.begin(), tied.end(), [](const TiedElement& left, const TiedElement& right) {
    return left.place.element < right.place.element;
  });
  return tied;
}

}  // namespace

KinematicMap make_kinematic_map(const Zone& zone, const fe::Mesh& mesh, const fe::Body& body,
                                std::span<const Vec3> centres, Ties ties) {
  zone.validate();
  const fe::Locator locator(mesh);
  check_surrounds(zone, mesh, locator);
  const std::vector<TiedElement> tied = find_tied(zone, mesh, locator, centres);
  KinematicMap map;
  map.ties = ties;
  std::vector<std::int32_t> place(body.nodes(), -1);  // of a node among map.nodes
  for (const TiedElement& one : tied) {
    map.elements.push_back(one.element);
    for (const std::int32_t node : body.connectivity[static_cast<std::size_t>(one.place.element)])
      place[static_cast<std::size_t>(node)] = 0;
  }
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] == 0) {
      place[i] = static_cast<std::int32_t>(map.nodes.size());
      map.nodes.push_back(static_cast<std::int32_t>(i));
    }

  std::vector<Eigen::Triplet<double, std::int32_t>> shape, curl;
  for (std::size_t i = 0; i < tied.size(); ++i) {
    const auto row = static_cast<std::int32_t>(i);
    const auto element = static_cast<std::size_t>(tied[i].place.element);
    const fe::ShapeValues n = fe::shape_values(tied[i].place.local);
    if (i == 0 || tied[i - 1].place.element != tied[i].place.element) {
      map.cell_first.push_back(row);
      for (const std::int32_t node : body.connectivity[element])
        map.cell_nodes.push_back(place[static_cast<std::size_t>(node)]);
    }
    const fe::ShapeGradients d = fe::gradients(mesh.corners(element), tied[i].place.local);
    for (int a = 0; a < 8; ++a) {
      const std::int32_t column =
          place[static_cast<std::size_t>(body.connectivity[element][static_cast<std::size_t>(a)])];
      shape.emplace_back(row, column, n[a]);
      map.shape.push_back(n[a]);
      if (ties == Ties::displacements) continue;
      for (int axis = 0; axis < 3; ++axis) {  // omega_i = (du_k/dx_j - du_j/dx_k)/2 with (i, j, k) cyclic
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        curl.emplace_back(3 * row + axis, 3 * column + k, 0.5 * d(a, j));
        curl.emplace_back(3 * row + axis, 3 * column + j, -0.5 * d(a, k));
      }
    }
  }
  map.cell_first.push_back(static_cast<std::int32_t>(tied.size()));
  const auto rows = static_cast<Eigen::Index>(map.elements.size()),
             columns = static_cast<Eigen::Index>(map.nodes.size());
  map.k.resize(rows, columns);
  map.k.setFromTriplets(shape.begin(), shape.end());
  if (ties == Ties::displacements_and_rotations) {
    map.h.resize(3 * rows, 3 * columns);
    map.h.setFromTriplets(curl.begin(), curl.end());
  }
  return map;
}

}  // namespace coupling
