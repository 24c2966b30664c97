// The critical time step against closed forms, and what happens on either side of it.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"
#include "tests/verification/scene.h"

using dem::Vec3;

TEST(CriticalStep, OfTwoSpheresIsThatOfTheirAxialOrTheirRollingMotion) {
  for (const double ratio : {0.05, 0.3, 1.0}) {
    dem::LinkLaw law = scene::elastic_law();
    law.shear_ratio = ratio;
    const scene::Pair pair(law);
    const dem::Particles& p = pair.assembly.particles;
    const double ma = p.element_mass(0), mb = p.element_mass(1);
    const double ia = p.element_inertia(0), ib = p.element_inertia(1);
    const double axial = pair.kn() * (1 / ma + 1 / mb);
    const double rolling = pair.ks() * (1 / ma + 1 / mb + 0.055 * 0.055 / ia + 0.045 * 0.045 / ib);
    const double expected = 2 / std::sqrt(std::max(axial, rolling));
    EXPECT_NEAR(scene::critical_step_of(pair.assembly), expected, 1e-9 * expected) << ratio;
    EXPECT_EQ(axial > rolling, ratio < 0.1) << "both motions have had their turn";
  }
}

TEST(CriticalStep, OfAChainIsThatOfItsShortestWave) {
  for (const int count : {3, 10, 100}) {
    dem::LinkLaw law = scene::elastic_law();
    law.shear_ratio = 0.01;  // the chain is stiffest along its axis
    const dem::Assembly chain = scene::chain(count, law);
    const double stiffness = law.normal_modulus * chain.links.area[0] * chain.links.inverse_initial_distance[0];
    const double mass = chain.particles.element_mass(0);
    const double omega =
        2 * std::sqrt(stiffness / mass) * std::sin((count - 1) * std::numbers::pi / (2 * count));
    // Lanczos comes from above: the step is never shorter than the true one, and at most 0.02% longer.
    const double found = scene::critical_step_of(chain);
    EXPECT_GE(found, 2 / omega * (1 - 1e-9)) << count;
    EXPECT_LE(found, 2 / omega * (1 + 2e-4)) << count;
  }
}

TEST(CriticalStep, OfAClusterIsThatOfItsDenseEigenproblem) {
  const dem::Assembly made = scene::cluster(40, scene::elastic_law(), 3);
  const dem::LinkNetwork network = scene::network_of(made);
  const auto size = static_cast<Eigen::Index>(6 * network.elements);
  Eigen::MatrixXd dynamic(size, size);
  Eigen::VectorXd unit(size), column(size);
  const auto mass = [&](Eigen::Index k) {
    return k % 6 < 3 ? made.particles.element_mass(static_cast<std::size_t>(k / 6))
                     : made.particles.element_inertia(static_cast<std::size_t>(k / 6));
  };
  for (Eigen::Index k = 0; k < size; ++k) {
    unit.setZero();
    unit[k] = 1;
    network.multiply({unit.data(), static_cast<std::size_t>(size)},
                     {column.data(), static_cast<std::size_t>(size)});
    for (Eigen::Index j = 0; j < size; ++j) dynamic(j, k) = column[j] / std::sqrt(mass(j) * mass(k));
  }
  const double omega = std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dynamic, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
  EXPECT_NEAR(scene::critical_step_of(made), 2 / omega, 2e-4 * 2 / omega);
}

namespace {

/// Energy after so many steps over the energy of the first.
double growth(const dem::Assembly& start, double fraction, int steps) {
  scene::Scene scene(start, fraction * scene::critical_step_of(start));
  scene.step();
  const double first = scene.kinetic + scene.energy().elastic;
  double now = first;
  for (int n = 0; n < steps && now < 1e6 * first; n += 50) {
    scene.steps(50);
    now = scene.kinetic + scene.energy().elastic;
  }
  return now / first;
}

}  // namespace

TEST(CriticalStep, SeparatesStableFromDivergentRunsOfASpecimen) {
  specimens::PackingOptions packing;
  packing.size = Vec3(0.25, 0.25, 0.25);
  packing.elements = 1350;
  packing.threads = 1;
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e15;
  dem::Assembly made = virtual_tests::make_assembly(specimens::make_specimen(packing), card);
  scene::shake(made.particles, 1e-6, 21);
  EXPECT_NEAR(growth(made, 0.95, 3000), 1, 1e-3);
  EXPECT_GT(growth(made, 1.1, 3000), 1e3);
}

TEST(CriticalStep, SeparatesStableFromDivergentRunsOfTwoSpheres) {
  scene::Pair pair(scene::elastic_law());
  dem::Assembly made = pair.assembly;
  for (const std::size_t i : {0u, 1u})
    for (int dof = 0; dof < 6; ++dof) made.particles.release(i, dof);
  scene::shake(made.particles, 1e-6, 22);
  EXPECT_NEAR(growth(made, 0.999, 3000), 1, 1e-3);
  EXPECT_GT(growth(made, 1.01, 3000), 1e3);
}
