// A bar of discrete elements whose far half may be finite elements, for the tests of the coupling. Periodic
// across, so that plane waves run along it; linear, so that what the interface does is seen without the pack's
// own noise.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "impact/coupling/multipliers.h"
#include "impact/coupling/sub_stepping.h"
#include "impact/coupling/zone.h"
#include "impact/fe/box_mesh.h"
#include "impact/fe/critical_step.h"
#include "libdem/core/random.h"

namespace coupling_scene {

using dem::Mat3;
using dem::Vec3;

/// Linear springs between spheres about their places at rest, compression or tension alike.
struct Network {
  struct Spring {
    std::size_t a, b;
    Vec3 normal;  // from a to b
    double arm_a, arm_b, normal_stiffness, shear_stiffness;
  };
  std::vector<Vec3> centres;
  std::vector<double> radii;
  std::vector<std::array<double, 6>> mass;  // (m, m, m, I, I, I)
  std::vector<Spring> springs;
  std::vector<double> u, v, f;  // six an element

  void clear_motion() { u.assign(6 * centres.size(), 0), v = u, f = u; }
  static Vec3 three(const std::vector<double>& from, std::size_t at) {
    return {from[at], from[at + 1], from[at + 2]};
  }

  /// Displacement of b against a at the contact point.
  static Vec3 opening(const Spring& s, const std::vector<double>& u) {
    const Vec3 turn = s.arm_a * three(u, 6 * s.a + 3) + s.arm_b * three(u, 6 * s.b + 3);
    return three(u, 6 * s.b) - three(u, 6 * s.a) - turn.cross(s.normal);
  }
  static Vec3 pull(const Spring& s, const Vec3& opening) {
    return (s.normal_stiffness - s.shear_stiffness) * opening.dot(s.normal) * s.normal +
           s.shear_stiffness * opening;
  }
  /// f = -K u.
  void force(const std::vector<double>& displacement, std::vector<double>& result) const {
    std::fill(result.begin(), result.end(), 0.0);
    for (const Spring& s : springs) add(s, pull(s, opening(s, displacement)), result);
  }
  static void add(const Spring& s, const Vec3& pulled, std::vector<double>& result) {
    const Vec3 turned = s.normal.cross(pulled);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      result[6 * s.a + c] += pulled[k], result[6 * s.b + c] -= pulled[k];
      result[6 * s.a + 3 + c] += s.arm_a * turned[k], result[6 * s.b + 3 + c] += s.arm_b * turned[k];
    }
  }
  double highest_frequency() const {
    dem::Random random(5);
    std::vector<double> x(6 * centres.size()), y(x.size());
    for (double& one : x) one = random.uniform(-1, 1);
    double omega2 = 0;
    for (int k = 0; k < 80; ++k) {
      force(x, y);
      double before = 0, after = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        y[i] /= -mass[i / 6][i % 6];
        before += x[i] * x[i], after += y[i] * y[i];
      }
      omega2 = std::sqrt(after / before);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = y[i] / std::sqrt(after);
    }
    return 1.02 * std::sqrt(omega2);
  }
};

/// A periodic pack: a jittered lattice whose overlaps are relaxed.
struct Pack {
  Vec3 size;
  std::vector<Vec3> centres;
  std::vector<double> radii;

  Vec3 nearest(Vec3 d) const {
    for (int k = 0; k < 3; ++k) d[k] -= size[k] * std::round(d[k] / size[k]);
    return d;
  }
  /// Calls `visit(i, j)` once for every pair whose centres are nearer than `reach`.
  template <class Visit>
  void near_pairs(double reach, Visit visit) const {
    std::array<int, 3> n{};
    for (int k = 0; k < 3; ++k)
      n[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(std::floor(size[k] / reach)));
    std::vector<std::vector<std::size_t>> cells(static_cast<std::size_t>(n[0] * n[1] * n[2]));
    const auto place = [&](const Vec3& x) {
      int at[3];
      for (int k = 0; k < 3; ++k) {
        const int m = n[static_cast<std::size_t>(k)];
        at[k] = ((static_cast<int>(std::floor(x[k] / size[k] * m)) % m) + m) % m;
      }
      return std::array<int, 3>{at[0], at[1], at[2]};
    };
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const auto c = place(centres[i]);
      cells[static_cast<std::size_t>((c[0] * n[1] + c[1]) * n[2] + c[2])].push_back(i);
    }
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const auto c = place(centres[i]);
      std::vector<int> seen;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dz = -1; dz <= 1; ++dz) {
            const int cell = (((c[0] + dx + n[0]) % n[0]) * n[1] + (c[1] + dy + n[1]) % n[1]) * n[2] +
                             (c[2] + dz + n[2]) % n[2];
            if (std::find(seen.begin(), seen.end(), cell) != seen.end()) continue;
            seen.push_back(cell);
            for (const std::size_t j : cells[static_cast<std::size_t>(cell)])
              if (i < j && nearest(centres[j] - centres[i]).norm() < reach) visit(i, j);
          }
    }
  }
};

inline Pack make_pack(const Vec3& size, double spacing, std::uint64_t seed) {
  Pack pack;
  pack.size = size;
  dem::Random random(seed);
  std::array<int, 3> n{};
  for (int k = 0; k < 3; ++k) n[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(size[k] / spacing));
  double volume = 0;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        const Vec3 jitter(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
        pack.centres.push_back((Vec3(i + 0.5, j + 0.5, k + 0.5) + jitter)
                                   .cwiseProduct(Vec3(size.x() / n[0], size.y() / n[1], size.z() / n[2])));
        pack.radii.push_back(random.uniform(0.8, 1.2));
        volume += 4.0 / 3 * std::numbers::pi * std::pow(pack.radii.back(), 3);
      }
  const double scale = std::cbrt(0.62 * size.prod() / volume);  // dense while relaxing
  for (double& r : pack.radii) r *= scale;
  for (int sweep = 0; sweep < 120; ++sweep) {
    std::vector<Vec3> move(pack.centres.size(), Vec3::Zero());
    pack.near_pairs(2.5 * scale, [&](std::size_t i, std::size_t j) {
      const Vec3 d = pack.nearest(pack.centres[j] - pack.centres[i]);
      const double overlap = pack.radii[i] + pack.radii[j] - d.norm();
      if (overlap <= 0) return;
      move[i] -= 0.4 * overlap * d.normalized(), move[j] += 0.4 * overlap * d.normalized();
    });
    for (std::size_t i = 0; i < move.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        double& x = pack.centres[i][k];
        x += move[i][k];
        x -= size[k] * std::floor(x / size[k]);
      }
  }
  for (double& r : pack.radii) r *= std::cbrt(0.42 / 0.62);  // then shrunk
  return pack;
}

/// Kn and Ks by Eq. 1 with Eq. 3's constants, 12 links an element; `closed_ends` links the ends to each other
/// too.
inline Network link(const Pack& pack, bool closed_ends, double density = 2500) {
  Network net;
  net.centres = pack.centres, net.radii = pack.radii;
  double volume = 0;
  for (const double r : pack.radii) volume += 4.0 / 3 * std::numbers::pi * r * r * r;
  for (const double r : pack.radii) {
    const double m = density * pack.size.prod() / volume * 4.0 / 3 * std::numbers::pi * r * r * r,
                 i = 0.4 * m * r * r;
    net.mass.push_back({m, m, m, i, i, i});
  }
  struct Pair {
    double ratio;
    std::size_t a, b;
  };
  std::vector<Pair> pairs;
  const double mean = std::cbrt(volume / static_cast<double>(pack.radii.size()) * 3 / (4 * std::numbers::pi));
  pack.near_pairs(4.4 * mean, [&](std::size_t i, std::size_t j) {
    pairs.push_back(
        {pack.nearest(pack.centres[j] - pack.centres[i]).norm() / (pack.radii[i] + pack.radii[j]), i, j});
  });
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.ratio < q.ratio; });
  pairs.resize(std::min(pairs.size(), 6 * pack.radii.size()));
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  const double e = 30e9, nu = 0.2, alpha = 3.7, beta = 2.198, gamma = 3.79;
  for (const Pair& p : pairs) {
    const Vec3 straight = pack.centres[p.b] - pack.centres[p.a], d = pack.nearest(straight);
    if (!closed_ends && std::abs(straight.x() - d.x()) > 1e-9) continue;
    const double ra = pack.radii[p.a], rb = pack.radii[p.b], distance = d.norm();
    const double area = std::numbers::pi * std::pow(std::min(ra, rb), 2), arm = ra + 0.5 * (distance - ra - rb);
    const double kn = e * area / distance * (1 + alpha) / (beta * (1 + nu) + gamma * (1 - alpha * nu));
    net.springs.push_back({p.a, p.b, d / distance, arm, distance - arm, kn, kn * (1 - alpha * nu) / (1 + nu)});
  }
  net.clear_motion();
  return net;
}

/// Twice the energy density of the closed pack under a uniform displacement gradient: the element of its
/// elasticity.
inline double modulus(const Pack& pack, const Mat3& gradient) {
  const Network net = link(pack, true);
  const Mat3 spin = 0.5 * (gradient - gradient.transpose());
  const Vec3 omega(spin(2, 1), spin(0, 2), spin(1, 0));
  std::vector<double> b(6 * net.centres.size(), 0.0);
  double affine = 0;
  for (const Network::Spring& s : net.springs) {
    const Vec3 opening =
        gradient * (s.arm_a + s.arm_b) * s.normal - ((s.arm_a + s.arm_b) * omega).cross(s.normal);
    affine += 0.5 * Network::pull(s, opening).dot(opening);
    Network::add(s, Network::pull(s, opening), b);
  }
  std::vector<double> x(b.size(), 0.0), r = b, p = b, q(b.size());
  const auto dot = [](const std::vector<double>& left, const std::vector<double>& right) {
    double sum = 0;
    for (std::size_t i = 0; i < left.size(); ++i) sum += left[i] * right[i];
    return sum;
  };
  double rr = dot(r, r);
  const double start = rr;
  for (int k = 0; k < 3000 && rr > 1e-14 * start; ++k) {
    net.force(p, q);
    const double step = -rr / dot(p, q);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * p[i], r[i] += step * q[i];
    const double next = dot(r, r);
    for (std::size_t i = 0; i < x.size(); ++i) p[i] = r[i] + next / rr * p[i];
    rr = next;
  }
  return 2 * (affine - 0.5 * dot(b, x)) / pack.size.prod();
}

/// Nodes of a bar that is periodic across: those on the far sides follow those on the near ones.
inline std::vector<std::int32_t> periodic_across(const fe::Mesh& mesh, const Vec3& size) {
  std::vector<std::int32_t> representative(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    Vec3 wanted = mesh.nodes[i];
    for (int k = 1; k < 3; ++k)
      if (wanted[k] > size[k] - 1e-9) wanted[k] = 0;
    representative[i] =
        fe::nodes_in_box(mesh, wanted - Vec3::Constant(1e-6), wanted + Vec3::Constant(1e-6)).front();
  }
  return representative;
}

}  // namespace coupling_scene
