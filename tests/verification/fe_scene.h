// Small bodies of finite elements for the verification tests.
#pragma once
#include <cmath>
#include <vector>

#include "impact/fe/body.h"
#include "impact/fe/box_mesh.h"
#include "impact/fe/static_solve.h"
#include "libdem/core/random.h"

namespace fe_scene {

using fe::Vec3;

inline fe::Material concrete(double poisson_ratio = 0.2) { return {30e9, poisson_ratio, 2500}; }

inline fe::BodyOptions with(fe::Formulation formulation) {
  fe::BodyOptions options;
  options.formulation = formulation;
  return options;
}

inline fe::Mesh box(const Vec3& size, std::array<int, 3> elements, const Vec3& origin = Vec3::Zero()) {
  fe::BoxMeshOptions options;
  options.origin = origin;
  options.size = size;
  options.elements = elements;
  return fe::box_mesh(options);
}

/// Moves the inner nodes at random by up to `by` along each axis; nodes on the surface stay on it.
inline fe::Mesh distorted(fe::Mesh mesh, double by, std::uint64_t seed = 1) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& node : mesh.nodes) low = low.cwiseMin(node), high = high.cwiseMax(node);
  dem::Random random(seed);
  for (Vec3& node : mesh.nodes)
    for (int k = 0; k < 3; ++k)
      if (node[k] > low[k] + 1e-9 && node[k] < high[k] - 1e-9) node[k] += random.uniform(-by, by);
  return mesh;
}

/// Loads by node of a traction [Pa] that `at` gives on the outer faces whose four corners satisfy `on`.
template <class On, class At>
std::vector<Vec3> surface_load(const fe::Mesh& mesh, On on, At at) {
  static constexpr int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<Vec3> load(mesh.nodes.size(), Vec3::Zero());
  const double q[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, w[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (const fe::Hexahedron& element : mesh.elements)
    for (const auto& corner : face) {
      std::size_t node[4];
      bool chosen = true;
      for (int a = 0; a < 4; ++a) {
        node[a] = static_cast<std::size_t>(element[static_cast<std::size_t>(corner[a])]);
        chosen = chosen && on(mesh.nodes[node[a]]);
      }
      if (!chosen) continue;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double n[4] = {0.25 * (1 - q[i]) * (1 - q[j]), 0.25 * (1 + q[i]) * (1 - q[j]),
                               0.25 * (1 + q[i]) * (1 + q[j]), 0.25 * (1 - q[i]) * (1 + q[j])};
          const double by_s[4] = {-0.25 * (1 - q[j]), 0.25 * (1 - q[j]), 0.25 * (1 + q[j]), -0.25 * (1 + q[j])};
          const double by_t[4] = {-0.25 * (1 - q[i]), -0.25 * (1 + q[i]), 0.25 * (1 + q[i]), 0.25 * (1 - q[i])};
          Vec3 x = Vec3::Zero(), s = Vec3::Zero(), t = Vec3::Zero();
          for (int a = 0; a < 4; ++a) {
            x += n[a] * mesh.nodes[node[a]];
            s += by_s[a] * mesh.nodes[node[a]];
            t += by_t[a] * mesh.nodes[node[a]];
          }
          const double area = s.cross(t).norm() * w[i] * w[j];
          for (int a = 0; a < 4; ++a) load[node[a]] += n[a] * area * at(x);
        }
    }
  return load;
}

}  // namespace fe_scene
