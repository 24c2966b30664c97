#include "libdem/statics/link_network.h"

#include <algorithm>
#include <numbers>

namespace dem {

LinkNetwork::LinkNetwork(std::span<const Vec3> centres, std::span<const double> radii,
                         std::span<const LinkGeometry> links, double normal_modulus, double shear_ratio)
    : elements(centres.size()) {
  springs.reserve(links.size());
  for (const LinkGeometry& link : links) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    const Vec3 apart = centres[b] - centres[a];
    const double distance = apart.norm(), r = std::min(radii[a], radii[b]);
    const double kn = normal_modulus * std::numbers::pi * r * r / link.initial_distance;
    const double arm_a = 0.5 * (distance + radii[a] - radii[b]);
    springs.push_back({link.a, link.b, apart / distance, arm_a, distance - arm_a, kn, shear_ratio * kn});
  }
}

LinkNetwork::LinkNetwork(std::span<const Vec3> centres, std::span<const double> radii,
                         std::span<const LinkGeometry> links, const LinkLaw& law)
    : LinkNetwork(centres, radii, links, law.normal_modulus, law.shear_ratio) {
  if (!law.transfers_moments) return;
  for (LinkSpring& spring : springs) {
    const double r =
        std::min(radii[static_cast<std::size_t>(spring.a)], radii[static_cast<std::size_t>(spring.b)]);
    spring.rolling_stiffness = law.moment.rolling_stiffness * spring.normal_stiffness * r * r;
    spring.twisting_stiffness = law.moment.twisting_stiffness * spring.normal_stiffness * r * r;
  }
}

void LinkNetwork::multiply(std::span<const double> displacement, std::span<double> force) const {
  std::fill(force.begin(), force.end(), 0.0);
  for (const LinkSpring& s : springs) {
    const double* ua = displacement.data() + 6 * s.a;
    const double* ub = displacement.data() + 6 * s.b;
    const double nx = s.normal.x(), ny = s.normal.y(), nz = s.normal.z();
    const double wx = s.arm_a * ua[3] + s.arm_b * ub[3];
    const double wy = s.arm_a * ua[4] + s.arm_b * ub[4];
    const double wz = s.arm_a * ua[5] + s.arm_b * ub[5];
    const double dx = ub[0] - ua[0] - (wy * nz - wz * ny);
    const double dy = ub[1] - ua[1] - (wz * nx - wx * nz);
    const double dz = ub[2] - ua[2] - (wx * ny - wy * nx);
    const double along = (s.normal_stiffness - s.shear_stiffness) * (dx * nx + dy * ny + dz * nz);
    const double fx = s.shear_stiffness * dx + along * nx;
    const double fy = s.shear_stiffness * dy + along * ny;
    const double fz = s.shear_stiffness * dz + along * nz;
    const double mx = ny * fz - nz * fy, my = nz * fx - nx * fz, mz = nx * fy - ny * fx;
    double* fa = force.data() + 6 * s.a;
    double* fb = force.data() + 6 * s.b;
    fa[0] -= fx, fa[1] -= fy, fa[2] -= fz;
    fb[0] += fx, fb[1] += fy, fb[2] += fz;
    fa[3] -= s.arm_a * mx, fa[4] -= s.arm_a * my, fa[5] -= s.arm_a * mz;
    fb[3] -= s.arm_b * mx, fb[4] -= s.arm_b * my, fb[5] -= s.arm_b * mz;
    if (s.rolling_stiffness == 0 && s.twisting_stiffness == 0) continue;
    const double rx = ub[3] - ua[3], ry = ub[4] - ua[4], rz = ub[5] - ua[5];
    const double twist = (s.twisting_stiffness - s.rolling_stiffness) * (rx * nx + ry * ny + rz * nz);
    const double tx = s.rolling_stiffness * rx + twist * nx, ty = s.rolling_stiffness * ry + twist * ny,
                 tz = s.rolling_stiffness * rz + twist * nz;
    fa[3] -= tx, fa[4] -= ty, fa[5] -= tz;
    fb[3] += tx, fb[4] += ty, fb[5] += tz;
  }
}

std::vector<int> LinkNetwork::coordination() const {
  std::vector<int> count(elements, 0);
  for (const LinkSpring& s : springs)
    ++count[static_cast<std::size_t>(s.a)], ++count[static_cast<std::size_t>(s.b)];
  return count;
}

}  // namespace dem
