#include "impact/impactors/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "libdem/core/error.h"

namespace impact {
namespace {

constexpr std::int32_t leaf_size = 4;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Throws for a corner that is no vertex or has no place: nothing later could make sense of it.
void require_finite(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                    const std::string& name) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::int32_t v : triangles[t]) {
      if (v < 0 || at(v) >= vertices.size())
        throw dem::InputError(fmt::format("{}: triangle {}", name, t + 1),
                              fmt::format("its corner {} is none of the {} vertices", v, vertices.size()),
                              "vertices are counted from 0");
      if (!vertices[at(v)].allFinite())
        throw dem::InputError(fmt::format("{}: triangle {}", name, t + 1),
                              "a coordinate is not a finite number", "write the mesh anew");
    }
}

/// Makes one vertex of all that have the same coordinates, numbered by these.
void weld(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, std::vector<Vec3>& points,
          std::vector<Triangle>& corners) {
  const auto before = [](const Vec3& p, const Vec3& q) {
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  for (const Triangle& triangle : triangles)
    for (const std::int32_t v : triangle) points.push_back(vertices[at(v)]);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  corners.reserve(triangles.size());
  for (const Triangle& triangle : triangles) {
    Triangle& welded = corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      welded[k] = static_cast<std::int32_t>(
          std::lower_bound(points.begin(), points.end(), vertices[at(triangle[k])], before) - points.begin());
  }
}

/// A triangle walks along an edge from one vertex to another.
struct Walk {
  std::int32_t from, to, triangle;
};

bool along_before(const Walk& one, const Walk& other) {
  return std::pair(one.from, one.to) < std::pair(other.from, other.to);
}

/// The nearest point of a triangle and the feature that it lies on: 0-2 a vertex, 3-5 the edge 01, 12, 20, 6
/// the face. After Ericson, Real-Time Collision Detection (2005), section 5.1.5.
struct OnTriangle {
  Vec3 point;
  int feature;
};

OnTriangle nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 3};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 5};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
  const double scale = 1 / (va + vb + vc);
  return {a + vb * scale * ab + vc * scale * ac, 6};
}

double squared_distance(const Eigen::AlignedBox3d& box, const Vec3& p) {
  return (p - p.cwiseMax(box.min()).cwiseMin(box.max())).squaredNorm();
}

}  // namespace

TriangleMesh::TriangleMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                           const std::string& name) {
  if (triangles.empty())
    throw dem::InputError(name, "the mesh has no triangle", "an impactor needs a closed surface");
  require_finite(vertices, triangles, name);
  weld(vertices, triangles, points, corners);
  require_area(name);
  find_normals(name);
  build_tree();
  double volume = 0;
  const Vec3 middle = bounding_box().center();
  for (const Triangle& t : corners)
    volume += (points[at(t[0])] - middle).dot((points[at(t[1])] - middle).cross(points[at(t[2])] - middle));
  if (!(volume > 0))
    throw dem::InputError(name, fmt::format("the mesh encloses a volume of {:.3g} m3", volume / 6),
                          "its triangles must run anticlockwise seen from outside: reverse them all");
}

void TriangleMesh::require_area(const std::string& name) const {
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Vec3 &a = points[at(corners[t][0])], &b = points[at(corners[t][1])], &c = points[at(corners[t][2])];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!((b - a).cross(c - a).norm() > 1e-12 * longest * longest))
      throw dem::InputError(fmt::format("{}: triangle {}", name, t + 1),
                            "it has no area: its corners lie on one line",
                            "remove degenerate triangles, a mesh repair does");
  }
}

void TriangleMesh::find_normals(const std::string& name) {
  // In a closed, consistently oriented surface exactly one triangle walks along an edge, and exactly one back.
  std::vector<Walk> walks;
  walks.reserve(3 * corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      walks.push_back({corners[t][k], corners[t][(k + 1) % 3], static_cast<std::int32_t>(t)});
  std::stable_sort(walks.begin(), walks.end(), along_before);
  const auto twice = std::adjacent_find(
      walks.begin(), walks.end(), [](const Walk& one, const Walk& other) { return !along_before(one, other); });
  if (twice != walks.end())
    throw dem::InputError(
        fmt::format("{}: triangle {}", name, std::next(twice)->triangle + 1),
        fmt::format("it runs along an edge in the same sense as triangle {}", twice->triangle + 1),
        "neighbours must be oriented alike, and an edge belongs to two triangles: repair the mesh");
  face_normal.resize(corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Vec3& a = points[at(corners[t][0])];
    face_normal[t] = (points[at(corners[t][1])] - a).cross(points[at(corners[t][2])] - a).normalized();
  }
  edge_normal.resize(corners.size());
  vertex_normal.assign(points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = corners[t][k], to = corners[t][(k + 1) % 3];
      const auto back = std::lower_bound(walks.begin(), walks.end(), Walk{to, from, 0}, along_before);
      if (back == walks.end() || back->from != to || back->to != from)
        throw dem::InputError(fmt::format("{}: triangle {}", name, t + 1),
                              "no other triangle shares one of its edges: the surface is open there",
                              "an impactor needs a closed surface: repair the mesh");
      edge_normal[t][k] = face_normal[t] + face_normal[at(back->triangle)];
      const Vec3 one = points[at(to)] - points[at(from)];
      const Vec3 other = points[at(corners[t][(k + 2) % 3])] - points[at(from)];
      vertex_normal[at(from)] += std::atan2(one.cross(other).norm(), one.dot(other)) * face_normal[t];
    }
}

void TriangleMesh::build_tree() {
  std::vector<Vec3> middles;  // three times over: only their order counts
  middles.reserve(corners.size());
  for (const auto& [a, b, c] : corners) middles.emplace_back(points[at(a)] + points[at(b)] + points[at(c)]);
  order.resize(corners.size());
  std::iota(order.begin(), order.end(), 0);
  nodes.reserve(corners.size());
  nodes.push_back({{}, 0, static_cast<std::int32_t>(corners.size())});
  for (std::size_t n = 0; n < nodes.size(); ++n) split(n, middles);
  fit_boxes();
}

void TriangleMesh::split(std::size_t n, const std::vector<Vec3>& middles) {
  const std::int32_t first = nodes[n].first, count = nodes[n].count;
  if (count <= leaf_size) return;
  Eigen::AlignedBox3d box;
  for (std::int32_t k = first; k < first + count; ++k) box.extend(middles[at(order[at(k)])]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto begin = order.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::int32_t s, std::int32_t t) {
    return std::pair(middles[at(s)][axis], s) < std::pair(middles[at(t)][axis], t);
  });
  // nth_element leaves the order within the halves to the library; bits must not depend on it.
  std::sort(begin, begin + count / 2);
  std::sort(begin + count / 2, begin + count);
  nodes[n].first = static_cast<std::int32_t>(nodes.size());
  nodes[n].count = 0;
  nodes.push_back({{}, first, count / 2});
  nodes.push_back({{}, first + count / 2, count - count / 2});
}

void TriangleMesh::fit_boxes() {
  leaf_corners.clear();
  leaf_corners.reserve(order.size());
  for (const std::int32_t t : order) {
    const auto& [a, b, c] = corners[at(t)];
    leaf_corners.push_back({points[at(a)], points[at(b)], points[at(c)]});
  }
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children come after their parents
    Node& node = nodes[n];
    node.box.setEmpty();
    for (std::int32_t k = node.first; k < node.first + node.count; ++k)
      for (const Vec3& p : leaf_corners[at(k)]) node.box.extend(p);
    if (node.count == 0) node.box = nodes[at(node.first)].box.merged(nodes[at(node.first + 1)].box);
  }
}

Nearest TriangleMesh::nearest(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  OnTriangle found{};
  std::int32_t leaf = 0;
  struct Waiting {
    std::int32_t node;
    double square;
  };
  std::array<Waiting, 128> stack;  // halving every node, 2^31 triangles are 31 levels deep
  std::size_t height = 0;
  stack[height++] = {0, 0};
  while (height > 0) {
    const Waiting next = stack[--height];
    if (next.square >= best) continue;
    const Node& node = nodes[at(next.node)];
    if (node.count > 0) {
      for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
        const auto& [a, b, c] = leaf_corners[at(k)];
        const OnTriangle here = nearest_on_triangle(p, a, b, c);
        const double square = (p - here.point).squaredNorm();
        if (square < best) best = square, found = here, leaf = k;
      }
      continue;
    }
    Waiting one{node.first, squared_distance(nodes[at(node.first)].box, p)};
    Waiting other{node.first + 1, squared_distance(nodes[at(node.first + 1)].box, p)};
    if (other.square < one.square) std::swap(one, other);
    stack[height++] = other;
    stack[height++] = one;
  }
  const std::size_t where = at(order[at(leaf)]);
  const auto f = static_cast<std::size_t>(found.feature);
  const Vec3 pseudo = f < 3   ? vertex_normal[at(corners[where][f])]
                      : f < 6 ? edge_normal[where][f - 3]
                              : face_normal[where];
  const Vec3 away = p - found.point;
  const double distance = std::sqrt(best), sign = away.dot(pseudo) < 0 ? -1 : 1;
  // On the surface the direction to it has drowned in rounding.
  const double scale = found.point.cwiseAbs().maxCoeff() + p.cwiseAbs().maxCoeff();
  const Vec3 normal = distance > 1e-12 * scale ? Vec3(sign / distance * away) : pseudo.normalized();
  return {sign * distance, found.point, normal};
}

void TriangleMesh::translate(const Vec3& by) {
  for (Vec3& p : points) p += by;
  fit_boxes();
}

}  // namespace impact
