#include "specimens/virtual_tests/membrane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace virtual_tests {
namespace {

using dem::Vec3;

/// A point of the section's outline and the direction outwards there, in the two directions after the axis.
struct OutlinePoint {
  double u, v, out_u, out_v;
};

/// Points around the section, counterclockwise seen against the axis.
std::vector<OutlinePoint> outline(const specimens::Specimen& specimen, int axis, double spacing) {
  std::vector<OutlinePoint> points;
  const double a = specimen.size[(axis + 1) % 3], b = specimen.size[(axis + 2) % 3];
  if (specimen.shape == specimens::Shape::cylinder) {
    const auto count = std::max(12L, std::lround(std::numbers::pi * a / spacing));
    const double turn = 2 * std::numbers::pi / static_cast<double>(count);
    const double radius = 0.5 * a * std::sqrt(turn / std::sin(turn));  // a polygon of the circle's area
    for (long k = 0; k < count; ++k) {
      const double c = std::cos(turn * static_cast<double>(k)), s = std::sin(turn * static_cast<double>(k));
      points.push_back({0.5 * a + radius * c, 0.5 * a + radius * s, c, s});
    }
    return points;
  }
  const auto along_a = std::max(2L, std::lround(a / spacing)), along_b = std::max(2L, std::lround(b / spacing));
  const auto part = [](long k, long count) { return static_cast<double>(k) / static_cast<double>(count); };
  const auto add = [&](double u, double v) {  // out of a corner, between the two faces
    const double out_u = u == 0 ? -1 : u == a ? 1 : 0, out_v = v == 0 ? -1 : v == b ? 1 : 0;
    const double norm = std::hypot(out_u, out_v);
    points.push_back({u, v, out_u / norm, out_v / norm});
  };
  for (long k = 0; k < along_a; ++k) add(a * part(k, along_a), 0);
  for (long k = 0; k < along_b; ++k) add(a, b * part(k, along_b));
  for (long k = along_a; k > 0; --k) add(a * part(k, along_a), b);
  for (long k = along_b; k > 0; --k) add(0, b * part(k, along_b));
  return points;
}

/// Weights of sum 1 that give points at these places, relative to the node, a mean of zero along `directions`;
/// the nearer the heavier.
std::vector<double> weights_of(const std::vector<Vec3>& places, const std::vector<Vec3>& directions) {
  const auto count = static_cast<Eigen::Index>(places.size()),
             rows = static_cast<Eigen::Index>(directions.size()) + 1;
  Eigen::MatrixXd conditions(rows, count);
  Eigen::VectorXd near(count), wanted = Eigen::VectorXd::Zero(rows);
  wanted[0] = 1;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vec3& place = places[static_cast<std::size_t>(k)];
    near[k] = 1 / place.squaredNorm();
    conditions(0, k) = 1;
    for (Eigen::Index r = 1; r < rows; ++r)
      conditions(r, k) = place.dot(directions[static_cast<std::size_t>(r - 1)]);
  }
  const Eigen::MatrixXd pulled = near.asDiagonal() * conditions.transpose();
  const Eigen::VectorXd weight = pulled * (conditions * pulled).ldlt().solve(wanted);
  return {weight.data(), weight.data() + count};
}

}  // namespace

Membrane::Membrane(const specimens::Specimen& specimen, int loaded) : axis(loaded) {
  const double size = specimen.element_size(), length = specimen.size[axis];
  const std::vector<OutlinePoint> ring = outline(specimen, axis, size);
  around = ring.size();
  levels = static_cast<std::size_t>(std::max(2L, std::lround(length / size))) + 1;
  // Elements near the sides, those that a node may hang on.
  std::vector<std::int32_t> near_sides;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    Vec3 inside = specimen.centres[i];
    inside[axis] = 0.5 * length;
    if (specimen.depth(inside) < 2.5 * size) near_sides.push_back(static_cast<std::int32_t>(i));
  }
  std::vector<std::pair<double, std::int32_t>> by_distance;
  for (std::size_t level = 0; level < levels; ++level) {
    const bool low_end = level == 0, high_end = level + 1 == levels;
    for (const OutlinePoint& point : ring) {
      Node node{};
      node.at_rest[axis] = length * static_cast<double>(level) / static_cast<double>(levels - 1);
      node.at_rest[(axis + 1) % 3] = point.u, node.at_rest[(axis + 2) % 3] = point.v;
      by_distance.clear();
      for (const std::int32_t i : near_sides) {
        const Vec3& centre = specimen.centres[static_cast<std::size_t>(i)];
        if ((low_end && centre[axis] >= size) || (high_end && centre[axis] <= length - size)) continue;
        by_distance.emplace_back((centre - node.at_rest).squaredNorm(), i);
      }
      const std::size_t count = std::min(carriers, by_distance.size());
      std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(count),
                        by_distance.end());
      std::vector<Vec3> places;
      for (std::size_t k = 0; k < count; ++k) {
        node.element[k] = by_distance[k].second;
        places.emplace_back(specimen.centres[static_cast<std::size_t>(node.element[k])] - node.at_rest);
      }
      for (std::size_t k = count; k < carriers; ++k) node.element[k] = node.element[0];  // without weight
      Vec3 across = Vec3::Zero();  // along the surface, across the axis
      across[(axis + 1) % 3] = -point.out_v, across[(axis + 2) % 3] = point.out_u;
      std::vector<Vec3> directions{across};
      if (!low_end && !high_end) directions.emplace_back(Vec3::Unit(axis));
      const std::vector<double> weights = weights_of(places, directions);
      std::copy(weights.begin(), weights.end(), node.weight.begin());
      nodes.push_back(node);
    }
  }
  for (std::size_t level = 0; level + 1 < levels; ++level)
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t next = (k + 1) % around, below = level * around, above = below + around;
      const std::array<std::size_t, 4> q{below + k, below + next, above + next, above + k};
      // Both ways to cut it in two, each for half of the pressure.
      for (const std::array<std::size_t, 3>& corner :
           {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}})
        triangles.push_back({q[corner[0]], q[corner[1]], q[corner[2]]});
    }
  std::vector<std::int32_t> touched;
  for (const Node& node : nodes) touched.insert(touched.end(), node.element.begin(), node.element.end());
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (Node& node : nodes)
    for (std::size_t k = 0; k < carriers; ++k)
      node.load[k] = static_cast<std::size_t>(
          std::lower_bound(touched.begin(), touched.end(), node.element[k]) - touched.begin());
  for (const std::int32_t element : touched) loads.push_back({element, Vec3::Zero(), Vec3::Zero()});
  now.resize(nodes.size());
  force.resize(nodes.size());
}

Vec3 Membrane::place(const Node& node, const dem::Particles& particles) {
  Vec3 at = node.at_rest;
  for (std::size_t k = 0; k < carriers; ++k)
    at += node.weight[k] * particles.displacement(static_cast<std::size_t>(node.element[k]));
  return at;
}

std::span<const dem::ElementLoad> Membrane::push(const dem::Particles& particles, double pressure) {
  for (std::size_t n = 0; n < nodes.size(); ++n) now[n] = place(nodes[n], particles), force[n] = Vec3::Zero();
  for (const std::array<std::size_t, 3>& t : triangles) {
    const Vec3 outwards = 0.5 * (now[t[1]] - now[t[0]]).cross(now[t[2]] - now[t[0]]);
    const Vec3 each = -(0.5 / 3) * pressure * outwards;
    for (const std::size_t n : t) force[n] += each;
  }
  for (dem::ElementLoad& load : loads) load.force = Vec3::Zero();
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t k = 0; k < carriers; ++k) loads[nodes[n].load[k]].force += nodes[n].weight[k] * force[n];
  return loads;
}

double Membrane::enclosed_area(const dem::Particles& particles) const {
  const std::size_t level = levels / 2 * around;
  double twice = 0;
  for (std::size_t k = 0; k < around; ++k) {
    const Vec3 a = place(nodes[level + k], particles), b = place(nodes[level + (k + 1) % around], particles);
    twice += a[(axis + 1) % 3] * b[(axis + 2) % 3] - a[(axis + 2) % 3] * b[(axis + 1) % 3];
  }
  return 0.5 * twice;
}

}  // namespace virtual_tests
