#include "impact/fe/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "impact/fe/hexahedron.h"
#include "libdem/core/error.h"

namespace fe {
namespace {

/// Below this the angles at a corner are so flat that stiffness and critical step lose their meaning.
constexpr double least_scaled_jacobian = 0.01;

/// Jacobian of the unit edges at the worst corner: 1 for a brick, 0 for a collapsed corner, negative if
/// inverted.
double worst_scaled_jacobian(const Corners& corners) {
  // The three neighbours of each corner, right-handed.
  static constexpr int neighbour[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                          {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double worst = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 8; ++a) {
    Mat3 edges;
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = corners.row(neighbour[a][k]) - corners.row(a);
      const double length = edge.norm();
      if (!(length > 0)) return 0;
      edges.col(k) = edge / length;
    }
    worst = std::min(worst, edges.determinant());
  }
  return worst;
}

void check_nodes_apart(const Mesh& mesh) {
  const double apart = 1e-6 * shortest_edge(mesh);
  std::vector<std::size_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return mesh.nodes[i].x() != mesh.nodes[j].x() ? mesh.nodes[i].x() < mesh.nodes[j].x() : i < j;
  });
  // Sorting by all coordinates within a plane of equal x keeps the sweep short on structured meshes.
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && mesh.nodes[order[end]].x() - mesh.nodes[order[end - 1]].x() <= apart) ++end;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
              order.begin() + static_cast<std::ptrdiff_t>(end), [&](std::size_t i, std::size_t j) {
                return mesh.nodes[i].y() != mesh.nodes[j].y() ? mesh.nodes[i].y() < mesh.nodes[j].y() : i < j;
              });
    for (std::size_t p = begin; p < end; ++p)
      for (std::size_t q = p + 1; q < end && mesh.nodes[order[q]].y() - mesh.nodes[order[p]].y() <= apart; ++q)
        if ((mesh.nodes[order[p]] - mesh.nodes[order[q]]).norm() <= apart)
          throw dem::InputError(
              mesh.origin,
              fmt::format("nodes {} and {} lie at the same place", mesh.node_tag(std::min(order[p], order[q])),
                          mesh.node_tag(std::max(order[p], order[q]))),
              "merge them (Gmsh: Coherence Mesh), or the mesh has a gap there");
    begin = end;
  }
}

}  // namespace

Corners Mesh::corners(std::size_t element) const {
  Corners result;
  for (int a = 0; a < 8; ++a)
    result.row(a) = nodes[static_cast<std::size_t>(elements[element][static_cast<std::size_t>(a)])];
  return result;
}

Vec3 Mesh::centre(std::size_t element) const { return corners(element).colwise().mean().transpose(); }

std::size_t Mesh::element_tag(std::size_t element) const {
  return element_tags.empty() ? element : element_tags[element];
}

std::size_t Mesh::node_tag(std::size_t node) const { return node_tags.empty() ? node : node_tags[node]; }

void check(const Mesh& mesh) {
  if (mesh.elements.empty())
    throw dem::InputError(mesh.origin, "the mesh has no element", "it needs at least one hexahedron");
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (!mesh.nodes[i].allFinite())
      throw dem::InputError(mesh.origin,
                            fmt::format("node {} has a coordinate that is no number", mesh.node_tag(i)),
                            "coordinates are finite, in metres");
  std::vector<bool> used(mesh.nodes.size(), false);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Hexahedron& element = mesh.elements[e];
    for (const std::int32_t node : element) {
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
        throw dem::InputError(
            mesh.origin,
            fmt::format("element {} names node {}, of {}", mesh.element_tag(e), node, mesh.nodes.size()),
            "every node of an element must exist");
      used[static_cast<std::size_t>(node)] = true;
    }
    const Corners corners = mesh.corners(e);
    const double quality = worst_scaled_jacobian(corners);
    double volume = std::numeric_limits<double>::infinity();
    for (const Vec3& point : gauss_points()) volume = std::min(volume, jacobian(corners, point).determinant());
    if (quality < 0 || !(volume > 0))
      throw dem::InputError(
          mesh.origin, fmt::format("element {} is inverted", mesh.element_tag(e)),
          "nodes go round one face counter-clockwise seen from inside, then round the opposite "
          "one, and no corner may turn inside out");
    if (quality < least_scaled_jacobian)
      throw dem::InputError(
          mesh.origin,
          fmt::format("element {} is degenerate (scaled Jacobian {:.2g})", mesh.element_tag(e), quality),
          fmt::format("at every corner it must be {} or more; a brick has 1", least_scaled_jacobian));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      throw dem::InputError(mesh.origin, fmt::format("node {} belongs to no element", mesh.node_tag(i)),
                            "take it out of the mesh");
  check_nodes_apart(mesh);
}

double shortest_edge(const Mesh& mesh) {
  static constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                      {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Corners corners = mesh.corners(e);
    for (const auto& [a, b] : edge) shortest = std::min(shortest, (corners.row(a) - corners.row(b)).norm());
  }
  return shortest;
}

std::vector<std::int32_t> nodes_in_box(const Mesh& mesh, const Vec3& low, const Vec3& high) {
  const double margin = 1e-9 * (high - low).norm();
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if ((mesh.nodes[i].array() >= low.array() - margin).all() &&
        (mesh.nodes[i].array() <= high.array() + margin).all())
      found.push_back(static_cast<std::int32_t>(i));
  return found;
}

}  // namespace fe
