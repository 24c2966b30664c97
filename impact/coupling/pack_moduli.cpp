#include "impact/coupling/pack_moduli.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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
  const Vec3 low = Vec3::Constant(inside_depth * size), high = cell.size - low;
  const auto three = [&](std::size_t at) {
    return Vec3(solution.displacement[at], solution.displacement[at + 1], solution.displacement[at + 2]);
  };
  double energy = 0;
  for (const dem::LinkSpring& s : network.springs) {
    const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
    const double part = part_inside(cell.centres[a], cell.centres[b], low, high);
    if (part == 0) continue;
    const Vec3 turn = s.arm_a * three(6 * a + 3) + s.arm_b * three(6 * b + 3);
    const Vec3 opening = three(6 * b) - three(6 * a) - turn.cross(s.normal);
    const double normal = opening.dot(s.normal);
    energy +=
        part * 0.5 *
        (s.normal_stiffness * normal * normal + s.shear_stiffness * (opening.squaredNorm() - normal * normal));
  }
  return 2 * energy / (high - low).prod();
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

/// The ends turn against each other about the middle surface, u_x = curvature x z, and slide freely in their
/// planes.
double flexural_modulus_of(const specimens::Specimen& cell, const dem::LinkNetwork& network, int along,
                           int through) {
  const int aside = 3 - along - through;
  const double size = cell.element_size(), length = cell.size[along], thickness = cell.size[through];
  const double curvature = test_strain / thickness;
  const auto dof = [](std::size_t i, int c) { return 6 * i + static_cast<std::size_t>(c); };
  const Vec3 middle = 0.5 * cell.size;
  std::vector<std::uint8_t> held(6 * cell.elements(), 0);
  std::vector<double> displacement(held.size(), 0.0);
  const auto at_end = [&](std::size_t i) {
    return cell.centres[i][along] < size || cell.centres[i][along] > length - size;
  };
  for (std::size_t i = 0; i < cell.elements(); ++i) {
    const Vec3 x = cell.centres[i] - middle;
    displacement[dof(i, along)] = curvature * x[along] * x[through];
    displacement[dof(i, through)] = -0.5 * curvature * x[along] * x[along];
    displacement[dof(i, 3 + aside)] = (aside == (along + 1) % 3 ? 1 : -1) * curvature * x[along];
    held[dof(i, along)] = at_end(i) ? 1 : 0;
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

  double moment = 0;  // mean of both ends, about the middle surface
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < cell.elements(); ++i) {
    const Vec3 x = cell.centres[i] - middle;
    if (at_end(i)) moment += 0.5 * (x[along] > 0 ? 1 : -1) * x[through] * solution.force[dof(i, along)];
    if (std::abs(x[along]) > 0.5 * length - std::min(inside_depth * size, 0.3 * length)) continue;
    const Eigen::Vector4d basis(1, x[along], x[through], x[along] * x[through]);
    normal += basis * basis.transpose();
    right += basis * solution.displacement[dof(i, along)];
  }
  const double found = normal.ldlt().solve(right)[3];
  return moment / (found * cell.size[aside] * std::pow(thickness, 3) / 12);
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
  virtual_tests::ElasticOptions options;
  options.axis = along;
  const virtual_tests::ElasticResult stretched = virtual_tests::run_elastic(cell, card, options);
  const bool has_inside = cell.size.minCoeff() >= needed;
  return {has_inside ? std::optional(bulk_modulus_of(cell, network)) : std::nullopt, stretched.young_modulus,
          flexural_modulus_of(cell, network, along, thickness_axis), stretched.poisson_ratio};
}

}  // namespace coupling
