#include "impact/coupling/pack_moduli.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "libdem/core/error.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/statics/static_solve.h"
#include "specimens/virtual_tests/elastic.h"

namespace coupling {
namespace {

using dem::Mat3;
using dem::Vec3;

constexpr double test_strain = 1e-4;                      // linear: any value gives the same moduli
constexpr double tolerance = 1e-6;                        // of the solver's residual
constexpr double prescribed_depth = 2, inside_depth = 4;  // element sizes from a face

/// The part of the segment from a to b that lies in the box [low, high], 0 to 1.
double part_inside(const Vec3& a, const Vec3& b, const Vec3& low, const Vec3& high) {
  double from = 0, to = 1;
  for (int k = 0; k < 3; ++k) {
    const double d = b[k] - a[k];
    if (std::abs(d) < 1e-300) {
      if (a[k] < low[k] || a[k] > high[k]) return 0;
      continue;
    }
    const double first = (low[k] - a[k]) / d, second = (high[k] - a[k]) / d;
    from = std::max(from, std::min(first, second));
    to = std::min(to, std::max(first, second));
  }
  return std::max(0.0, to - from);
}

/// A box of the cell in which something is averaged.
struct Region {
  Vec3 low, high;
};

/// Elastic energy of the links in the region, those that cross its faces in part [J].
double energy_in(const Region& region, const specimens::Specimen& cell, const dem::LinkNetwork& network,
                 const std::vector<double>& displacement) {
  const auto three = [&](std::size_t at) {
    return Vec3(displacement[at], displacement[at + 1], displacement[at + 2]);
  };
  double energy = 0;
  for (const dem::LinkSpring& s : network.springs) {
    const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
    const double part = part_inside(cell.centres[a], cell.centres[b], region.low, region.high);
    if (part == 0) continue;
    const Vec3 turn = s.arm_a * three(6 * a + 3) + s.arm_b * three(6 * b + 3);
    const Vec3 opening = three(6 * b) - three(6 * a) - turn.cross(s.normal);
    const double normal = opening.dot(s.normal);
    energy +=
        part * 0.5 *
        (s.normal_stiffness * normal * normal + s.shear_stiffness * (opening.squaredNorm() - normal * normal));
  }
  return energy;
}

/// Twice the energy density of the inside [Pa] when the faces follow a uniform strain and the rest finds its
/// own place.
double inside_modulus(const specimens::Specimen& cell, const dem::LinkNetwork& network, const Mat3& strain) {
  std::vector<std::uint8_t> held(6 * cell.elements(), 0);
  std::vector<double> displacement(held.size(), 0.0);
  const double size = cell.element_size();
  for (std::size_t i = 0; i < cell.elements(); ++i) {
    const Vec3 u = strain * cell.centres[i];
    for (std::size_t c = 0; c < 3; ++c) displacement[6 * i + c] = u[static_cast<Eigen::Index>(c)];
    if (cell.depth(cell.centres[i]) < prescribed_depth * size)
      std::fill_n(held.begin() + static_cast<std::ptrdiff_t>(6 * i), 6, std::uint8_t{1});
  }
  const dem::StaticSolution solution = dem::solve_static(network, held, displacement, tolerance);
  const Vec3 low = Vec3::Constant(inside_depth * size);
  const Region inside{low, cell.size - low};
  return 2 * energy_in(inside, cell, network, solution.displacement) / (inside.high - inside.low).prod();
}

/// E of the inside from C11 and C12, each averaged over the three axes as for an isotropic material.
double bulk_modulus_of(const specimens::Specimen& cell, const dem::LinkNetwork& network) {
  double c11 = 0, together = 0;
  for (int k = 0; k < 3; ++k) {
    Mat3 one = Mat3::Zero(), two = Mat3::Zero();
    one(k, k) = two(k, k) = two((k + 1) % 3, (k + 1) % 3) = test_strain;
    c11 += inside_modulus(cell, network, one) / (3 * test_strain * test_strain);
    together += inside_modulus(cell, network, two) / (3 * test_strain * test_strain);
  }
  const double c12 = 0.5 * (together - 2 * c11);
  return (c11 - c12) * (c11 + 2 * c12) / (c11 + c12);
}

/// The whole thickness, away from the ends and from the sides: the structure goes on there, the cell does not,
/// and its own ends and sides are softer than its middle.
Region middle_of(const specimens::Specimen& cell, int through) {
  Region region{Vec3::Zero(), cell.size};
  for (int k = 0; k < 3; ++k) {
    if (k == through) continue;
    const double depth = std::min(inside_depth * cell.element_size(), 0.3 * cell.size[k]);
    region.low[k] = depth;
    region.high[k] -= depth;
  }
  return region;
}

/// Coefficients of u_along = c0 + c1 x_along + c2 x_through + c3 x_along x_through in the region, about the
/// cell's middle.
Eigen::Vector4d stretching_of(const Region& region, const specimens::Specimen& cell,
                              const std::vector<double>& displacement, int along, int through) {
  const Vec3 middle = 0.5 * cell.size;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < cell.elements(); ++i) {
    const Vec3& at = cell.centres[i];
    if ((at.array() < region.low.array()).any() || (at.array() > region.high.array()).any()) continue;
    const Vec3 x = at - middle;
    const Eigen::Vector4d basis(1, x[along], x[through], x[along] * x[through]);
    normal += basis * basis.transpose();
    right += basis * displacement[6 * i + static_cast<std::size_t>(along)];
  }
  return normal.ldlt().solve(right);
}

/// E of the whole section, stretched, and its Poisson's ratio: U = E strain^2 V / 2.
std::pair<double, double> membrane_modulus_of(const specimens::Specimen& cell, const dem::LinkLaw& law,
                                              const dem::LinkNetwork& network, int along, int through) {
  virtual_tests::ElasticOptions options;
  options.axis = along;
  std::vector<double> displacement;
  const virtual_tests::ElasticResult stretched =
      virtual_tests::run_elastic(cell, law.normal_modulus, law.shear_ratio, options, &displacement);
  const Region region = middle_of(cell, through);
  const double strain = stretching_of(region, cell, displacement, along, through)[1];
  const double energy = energy_in(region, cell, network, displacement);
  return {2 * energy / (strain * strain * (region.high - region.low).prod()), stretched.poisson_ratio};
}

/// The ends turn against each other about the middle surface, u_x = curvature x z, and slide freely in their
/// planes. E of the whole section from U = E curvature^2 I L / 2.
double flexural_modulus_of(const specimens::Specimen& cell, const dem::LinkNetwork& network, int along,
                           int through) {
  const int aside = 3 - along - through;
  const double size = cell.element_size(), length = cell.size[along], thickness = cell.size[through];
  const double curvature = test_strain / thickness;
  const auto dof = [](std::size_t i, int c) { return 6 * i + static_cast<std::size_t>(c); };
  const Vec3 middle = 0.5 * cell.size;
  std::vector<std::uint8_t> held(6 * cell.elements(), 0);
  std::vector<double> displacement(held.size(), 0.0);
  for (std::size_t i = 0; i < cell.elements(); ++i) {
    const Vec3 x = cell.centres[i] - middle;
    displacement[dof(i, along)] = curvature * x[along] * x[through];
    displacement[dof(i, through)] = -0.5 * curvature * x[along] * x[along];
    displacement[dof(i, 3 + aside)] = (aside == (along + 1) % 3 ? 1 : -1) * curvature * x[along];
    held[dof(i, along)] = std::abs(x[along]) > 0.5 * length - size ? 1 : 0;
  }
  // Hold just what would drift: both ends' centres sideways, and one more element against turning about the
  // length.
  const auto pin = [&](const Vec3& target) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < cell.elements(); ++i)
      if ((cell.centres[i] - target).squaredNorm() < (cell.centres[best] - target).squaredNorm()) best = i;
    return best;
  };
  for (const double end : {0.0, length}) {
    Vec3 target = middle;
    target[along] = end;
    const std::size_t centre = pin(target);
    for (const int c : {aside, through}) held[dof(centre, c)] = 1;
    target[aside] = 0;
    if (end == 0) held[dof(pin(target), through)] = 1;
  }
  const dem::StaticSolution solution = dem::solve_static(network, held, displacement, tolerance);
  const Region region = middle_of(cell, through);
  const double found = stretching_of(region, cell, solution.displacement, along, through)[3];
  const Vec3 extent = region.high - region.low;
  const double inertia = extent[aside] * std::pow(thickness, 3) / 12;
  return 2 * energy_in(region, cell, network, solution.displacement) /
         (found * found * inertia * extent[along]);
}

}  // namespace

PackModuli measure_moduli(const specimens::Specimen& cell, const dem::MaterialCard& card, int thickness_axis,
                          int along) {
  const char* where = "cell for the moduli";
  if (cell.shape != specimens::Shape::box || thickness_axis == along || std::min(thickness_axis, along) < 0 ||
      std::max(thickness_axis, along) > 2)
    throw dem::InputError(where, "it is no box, or its two axes are the same",
                          "give a box and two of its axes");
  const double size = cell.element_size(), needed = (2 * inside_depth + 2) * size;
  if (!(cell.size[along] >= 1.5 * cell.size[thickness_axis]))
    throw dem::InputError(
        where,
        fmt::format("it is {:.3g} m long and {:.3g} m thick", cell.size[along], cell.size[thickness_axis]),
        "it must be at least 1.5 times as long as thick");
  const dem::LinkLaw law = dem::make_link_law(card);
  const dem::LinkNetwork network(cell.centres, cell.radii, cell.links, law.normal_modulus, law.shear_ratio);
  const bool has_inside = cell.size.minCoeff() >= needed;
  const auto [membrane, poisson_ratio] = membrane_modulus_of(cell, law, network, along, thickness_axis);
  return {has_inside ? std::optional(bulk_modulus_of(cell, network)) : std::nullopt, membrane,
          flexural_modulus_of(cell, network, along, thickness_axis), poisson_ratio};
}

}  // namespace coupling
