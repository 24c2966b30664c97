// Elasticity: the static solve against a dense solver, against the dynamic step, and against bounds.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/material/micro_macro.h"
#include "libdem/statics/static_solve.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/uniaxial.h"
#include "tests/verification/scene.h"

using dem::Vec3;

namespace {

const specimens::Specimen& prism() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.size = Vec3(0.5, 0.25, 0.25);
    packing.elements = 2700;
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  return made;
}

}  // namespace

TEST(MicroMacro, HasTheCheckValuesOfEquationOne) {
  const dem::LinkStiffness paper = dem::link_stiffness(1, 0.2, 3.7, 2.198, 3.79);
  EXPECT_NEAR(paper.shear_ratio, 0.21667, 5e-6);
  EXPECT_NEAR(paper.normal_modulus, 1.29727, 5e-6);
  const dem::LinkStiffness hentz = dem::link_stiffness(1, 0.2, 2.5, 2.0, 2.65);
  EXPECT_NEAR(hentz.shear_ratio, 0.41667, 5e-6);
  EXPECT_NEAR(hentz.normal_modulus, 0.93960, 5e-6);
}

TEST(StaticSolve, AgreesWithADenseSolveOfASeparatelyAssembledMatrix) {
  const dem::Assembly made = scene::cluster(24, scene::elastic_law(), 31, 3);
  const dem::LinkNetwork network = scene::network_of(made);
  for (const int links : network.coordination())
    ASSERT_GE(links, 3);  // fewer would be held by the solve itself
  const std::size_t size = 6 * network.elements;
  // K from the energy of each link: 1/2 kn (stretch)^2 + 1/2 ks |slip|^2, each linear in the twelve unknowns.
  Eigen::MatrixXd stiffness =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  for (const dem::LinkGeometry& link : scene::geometry_of(made.links)) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    const Vec3 xa = made.particles.initial_position[a], xb = made.particles.initial_position[b];
    const double ra = made.particles.radius[a], rb = made.particles.radius[b];
    const double smaller = std::min(ra, rb);
    const double kn = made.law.normal_modulus * std::numbers::pi * smaller * smaller / link.initial_distance;
    const Vec3 n = (xb - xa).normalized();
    const Vec3 contact = xa + (ra + 0.5 * ((xb - xa).norm() - ra - rb)) * n;   // P_c, Eq. 2
    Eigen::Matrix<double, 3, 12> jump = Eigen::Matrix<double, 3, 12>::Zero();  // motion of b past a at P_c
    for (int c = 0; c < 3; ++c) {
      const Vec3 unit = Vec3::Unit(c);
      jump.col(c) = -unit, jump.col(6 + c) = unit;
      jump.col(3 + c) = -unit.cross(contact - xa), jump.col(9 + c) = unit.cross(contact - xb);
    }
    const dem::Mat3 springs =
        kn * (n * n.transpose() + made.law.shear_ratio * (dem::Mat3::Identity() - n * n.transpose()));
    const Eigen::Matrix<double, 12, 12> k = jump.transpose() * springs * jump;
    const Eigen::Index place[2] = {static_cast<Eigen::Index>(6 * a), static_cast<Eigen::Index>(6 * b)};
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) stiffness.block<6, 6>(place[r], place[c]) += k.block<6, 6>(6 * r, 6 * c);
  }
  // Hold the first element, move the last along x, turn another.
  std::vector<std::uint8_t> held(size, 0);
  std::vector<double> displacement(size, 0);
  for (std::size_t c = 0; c < 6; ++c) held[c] = 1;
  held[size - 6] = 1, displacement[size - 6] = 1e-5;
  held[6 * 7 + 5] = 1, displacement[6 * 7 + 5] = 2e-4;
  const dem::StaticSolution solution = dem::solve_static(network, held, displacement, 1e-12);

  std::vector<Eigen::Index> free, fixed;
  for (std::size_t k = 0; k < size; ++k) (held[k] ? fixed : free).push_back(static_cast<Eigen::Index>(k));
  const Eigen::VectorXd prescribed = Eigen::Map<Eigen::VectorXd>(displacement.data(), stiffness.rows())(fixed);
  Eigen::VectorXd dense = Eigen::VectorXd::Zero(stiffness.rows());
  dense(fixed) = prescribed;
  const Eigen::MatrixXd inner = stiffness(free, free), beside = stiffness(free, fixed);
  const Eigen::VectorXd load = -(beside * prescribed), moved = inner.ldlt().solve(load);
  dense(free) = moved;
  const Eigen::VectorXd reaction = stiffness * dense;
  const Eigen::Map<const Eigen::VectorXd> found(solution.displacement.data(), stiffness.rows());
  const Eigen::Map<const Eigen::VectorXd> force(solution.force.data(), stiffness.rows());
  EXPECT_LT((found - dense).norm(), 1e-8 * dense.norm());
  EXPECT_LT((force - reaction).norm(), 1e-8 * reaction.norm());
  EXPECT_GT(reaction.norm(), 0);
}

TEST(StaticSolve, UsesTheTangentOfTheDynamicLaw) {
  dem::Assembly made = scene::cluster(60, scene::elastic_law(), 32);
  const dem::LinkNetwork network = scene::network_of(made);
  const std::size_t size = 6 * network.elements;
  scene::Scene scene(made, 1e-6);
  // One step that moves and turns every element by a little; forces follow to first order.
  dem::Random random(33);
  std::vector<double> displacement(size), force(size);
  for (std::size_t k = 0; k < size; ++k) displacement[k] = random.uniform(-1, 1) * (k % 6 < 3 ? 1e-9 : 1e-7);
  const double dt = scene.options.time_step;
  for (std::size_t i = 0; i < network.elements; ++i) {
    const double* u = displacement.data() + 6 * i;
    scene.hold(i, Vec3(u[0], u[1], u[2]) / dt, Vec3(u[3], u[4], u[5]) / dt);
  }
  scene.step();
  network.multiply(displacement, force);
  double largest_force = 0, largest_moment = 0;
  for (std::size_t k = 0; k < size; ++k)
    (k % 6 < 3 ? largest_force : largest_moment) =
        std::max(k % 6 < 3 ? largest_force : largest_moment, std::abs(force[k]));
  for (std::size_t k = 0; k < size; ++k)
    EXPECT_NEAR(scene.particles().force[k / 6].value[k % 6], -force[k],
                1e-5 * (k % 6 < 3 ? largest_force : largest_moment))
        << k;
}

TEST(ElasticTest, AgreesWithASlowDynamicTensionTestInWhichNothingBreaks) {
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e12;
  virtual_tests::UniaxialOptions options;
  options.expected_strength = 3e6;
  options.max_strain = 1.5e-4;
  const auto dynamic = virtual_tests::run_uniaxial(prism(), card, options);
  const auto fixed = virtual_tests::run_elastic(prism(), card);
  ASSERT_EQ(dynamic.broken_links, 0u);
  RecordProperty("E_dynamic_over_static", std::to_string(dynamic.young_modulus / fixed.young_modulus));
  RecordProperty("nu_dynamic_over_static", std::to_string(dynamic.poisson_ratio / fixed.poisson_ratio));
  EXPECT_NEAR(dynamic.young_modulus, fixed.young_modulus, 0.01 * fixed.young_modulus);
  EXPECT_NEAR(dynamic.poisson_ratio, fixed.poisson_ratio, 0.01 * fixed.poisson_ratio);
}

TEST(ElasticTest, DoesNotDependOnTheFirstGuess) {
  std::vector<double> guess;
  const auto soft = virtual_tests::run_elastic(prism(), 40e9, 0.1, {.tolerance = 1e-8}, &guess);
  const auto warm = virtual_tests::run_elastic(prism(), 40e9, 0.3, {.tolerance = 1e-8}, &guess);
  const auto cold = virtual_tests::run_elastic(prism(), 40e9, 0.3, {.tolerance = 1e-8});
  EXPECT_LT(soft.young_modulus, warm.young_modulus);
  EXPECT_NEAR(warm.young_modulus, cold.young_modulus, 1e-6 * cold.young_modulus);
  EXPECT_NEAR(warm.poisson_ratio, cold.poisson_ratio, 1e-6);
}

TEST(ElasticTest, StaysBelowTheKinematicBound) {
  // Every element follows the mean strain: alpha = 4, beta = 2c, gamma = 3c, c = sum(S_int D_init)/(3 V), if
  // links point everywhere alike; for the links as they are, 1/V times the sum of their energies under each
  // strain. Counted in the middle half, where the modulus is measured too: towards the platens links are
  // missing.
  const specimens::Specimen& specimen = prism();
  const double volume = 0.5 * specimen.volume();
  std::array<dem::Mat3, 6> strains;
  for (int p = 0; p < 6; ++p) {
    const int r = p < 3 ? p : p - 3, c = p < 3 ? p : (p - 2) % 3;
    strains[static_cast<std::size_t>(p)] = dem::Mat3::Zero();
    strains[static_cast<std::size_t>(p)](r, c) = strains[static_cast<std::size_t>(p)](c, r) = 1;
  }
  for (const double ratio : {0.05, 0.2, 0.5, 1.0}) {
    double sum = 0;
    Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
    for (const dem::LinkGeometry& link : specimen.links) {
      const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
      const double middle = 0.5 * (specimen.centres[a].x() + specimen.centres[b].x()) / specimen.size.x();
      if (middle < 0.25 || middle > 0.75) continue;
      const double r = std::min(specimen.radii[a], specimen.radii[b]);
      const double weight = std::numbers::pi * r * r * link.initial_distance;
      const Vec3 n = (specimen.centres[b] - specimen.centres[a]).normalized();
      sum += weight;
      for (int p = 0; p < 6; ++p)
        for (int q = 0; q < 6; ++q) {
          const Vec3 up = strains[static_cast<std::size_t>(p)] * n,
                     uq = strains[static_cast<std::size_t>(q)] * n;
          stiffness(p, q) += weight / volume * ((1 - ratio) * n.dot(up) * n.dot(uq) + ratio * up.dot(uq));
        }
    }
    const double bound = 1 / stiffness.inverse()(0, 0), c = sum / (3 * volume);
    const double isotropic = dem::macro_elasticity({1, ratio}, 4, 2 * c, 3 * c).young_modulus;
    const double modulus = virtual_tests::run_elastic(specimen, 1, ratio).young_modulus;
    RecordProperty("part_of_bound_at_" + std::to_string(ratio), std::to_string(modulus / bound));
    RecordProperty("isotropic_at_" + std::to_string(ratio), std::to_string(modulus / isotropic));
    EXPECT_LT(modulus, bound) << ratio;
    EXPECT_GT(modulus, 0.7 * bound) << ratio;              // and is of its order
    EXPECT_NEAR(isotropic, bound, 0.08 * bound) << ratio;  // the sides favour links along them
  }
}

TEST(StaticSolve, StoresNoMoreEnergyThanAnyOtherFieldWithItsPrescribedValues) {
  const specimens::Specimen& specimen = prism();
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, 1e9, 0.2);
  const std::size_t size = 6 * network.elements;
  std::vector<std::uint8_t> held(size, 0);
  std::vector<double> affine(size, 0), force(size);
  const double platen = specimen.element_size(), length = specimen.size.x();
  for (std::size_t i = 0; i < network.elements; ++i) {
    const double x = specimen.centres[i].x();
    affine[6 * i] = 1e-4 * std::clamp(x, platen, length - platen);
    if (x < platen || x > length - platen)
      for (std::size_t c = 0; c < 3; ++c) held[6 * i + c] = 1;
  }
  const auto energy = [&](const std::vector<double>& u) {
    network.multiply(u, force);
    double twice = 0;
    for (std::size_t k = 0; k < size; ++k) twice += u[k] * force[k];
    return twice / 2;
  };
  const dem::StaticSolution solution = dem::solve_static(network, held, affine, 1e-10);
  const double least = energy(solution.displacement);
  EXPECT_LT(least, energy(affine));
  // First order: no small change of the free values lowers or raises it; second order: it rises.
  dem::Random random(34);
  std::vector<double> other = solution.displacement;
  for (std::size_t k = 0; k < size; ++k)
    if (!held[k]) other[k] += 1e-9 * random.uniform(-1, 1);
  EXPECT_GT(energy(other), least);
  double residual = 0, reaction = 0;
  network.multiply(solution.displacement, force);
  for (std::size_t k = 0; k < size; ++k) (held[k] ? reaction : residual) += force[k] * force[k];
  EXPECT_LT(std::sqrt(residual), 1e-8 * std::sqrt(reaction));
}

TEST(StaticSolve, StopsAtASignal) {
  dem::set_interrupt(true);
  EXPECT_THROW(virtual_tests::run_elastic(prism(), 1e9, 0.2), dem::Interrupted);
  dem::set_interrupt(false);
  EXPECT_NO_THROW(virtual_tests::run_elastic(prism(), 1e9, 0.2));
}
