// The law that transfers moments, driven through the real step.
#include <gtest/gtest.h>

#include <cmath>

#include "libdem/probe/damage.h"
#include "tests/verification/scene.h"

using dem::Vec3;
using scene::Pair;
using scene::plain_law;
using scene::with_moments;

namespace {

/// Rolling, and nothing else that yields.
dem::LinkLaw rolling_law() {
  dem::LinkLaw law = with_moments(scene::elastic_law());
  law.slip_softening = 0;
  return law;
}

double radius_squared() { return Pair::rb * Pair::rb; }  // R = min(Ra, Rb)

/// Turns b about `axis` by `angle`, and a by the opposite so that nothing slides at the contact point, when the
/// arms allow it.
void turn_b(Pair& pair, const Vec3& axis, double angle, int count) {
  pair.hold(1, Vec3::Zero(), axis * (angle / count / pair.options.time_step));
  pair.steps(count);
  pair.hold(1);
}

/// The moment on a that is not its share of the shear force's.
Vec3 transferred(const Pair& pair) {
  const Vec3 n = (pair.position(1) - pair.position(0)).normalized();
  const double arm = 0.5 * (pair.gap() + Pair::ra - Pair::rb);
  return pair.moment(0) - arm * n.cross(pair.shear());
}

}  // namespace

TEST(MomentTransfer, RollingRisesWithItsStiffnessAndStopsAtItsPartOfTheNormalForce) {
  Pair pair(rolling_law());
  pair.stretch_to(-1e-4);
  const double stiffness = 0.25 * pair.kn() * radius_squared(), limit = 0.5 * Pair::rb * pair.normal();
  const double angle = 0.5 * limit / stiffness;
  turn_b(pair, Vec3(0, 0, 1), angle, 100);
  EXPECT_NEAR(transferred(pair).z(), stiffness * angle, 1e-6 * limit) << "a is turned along by b";
  EXPECT_NEAR(transferred(pair).x(), 0, 1e-12 * limit);
  turn_b(pair, Vec3(0, 0, 1), 3 * angle, 300);
  EXPECT_NEAR(transferred(pair).norm(), limit, 1e-9 * limit);
  EXPECT_GT(pair.sliding, 0);
  turn_b(pair, Vec3(0, 0, 1), -angle, 100);
  EXPECT_NEAR(transferred(pair).z(), limit - stiffness * angle, 1e-6 * limit) << "unloads elastically";
}

TEST(MomentTransfer, TwistingHasItsOwnStiffnessAndLimit) {
  Pair pair(rolling_law());
  pair.stretch_to(-1e-4);
  const double stiffness = 0.1 * pair.kn() * radius_squared(), limit = 0.2 * Pair::rb * pair.normal();
  turn_b(pair, Vec3(1, 0, 0), 0.5 * limit / stiffness, 100);
  EXPECT_NEAR(transferred(pair).x(), 0.5 * limit, 1e-6 * limit);
  EXPECT_NEAR(transferred(pair).y(), 0, 1e-12 * limit);
  turn_b(pair, Vec3(1, 0, 0), 2 * limit / stiffness, 100);
  EXPECT_NEAR(transferred(pair).x(), limit, 1e-9 * limit);
}

TEST(MomentTransfer, VanishesInTensionWithWhatItHadStoredDissipated) {
  Pair pair(rolling_law());
  pair.stretch_to(-1e-4);
  turn_b(pair, Vec3(0, 1, 0), 1e-5, 100);
  ASSERT_GT(transferred(pair).norm(), 0);
  const double stored = 0.5 * transferred(pair).squaredNorm() / (0.25 * pair.kn() * radius_squared());
  const double before = pair.sliding;
  pair.stretch_to(1e-5, 2000);
  EXPECT_EQ(transferred(pair).norm(), 0);
  EXPECT_GT(pair.sliding - before, 0.9 * stored);
  turn_b(pair, Vec3(0, 1, 0), 1e-3, 100);
  EXPECT_EQ(pair.assembly.links.moment_y[0], 0);
}

TEST(MomentTransfer, TurnsWithThePairAndKeepsItsSizeInARigidRotation) {
  Pair pair(rolling_law());
  pair.stretch_to(-1e-4);
  turn_b(pair, Vec3(0, 0, 1), 2e-5, 100);
  turn_b(pair, Vec3(1, 0, 0), 2e-5, 100);
  const Vec3 start = transferred(pair);
  const Vec3 axis = Vec3(1, 2, -1).normalized();
  const int count = 2000;
  const double each = 1.0 / count, dt = pair.options.time_step;
  const dem::Mat3 turn = Eigen::AngleAxisd(each, axis).toRotationMatrix();
  for (int n = 0; n < count; ++n) {
    for (const std::size_t i : {0u, 1u}) {
      const Vec3 x = pair.position(i);
      pair.hold(i, (turn * x - x) / dt, each / dt * axis);
    }
    pair.step();
  }
  const Vec3 expected = Eigen::AngleAxisd(1.0, axis).toRotationMatrix() * start;
  EXPECT_LT((transferred(pair) - expected).norm(), 1e-4 * start.norm());
}

TEST(MomentTransfer, WorkOfTurningIsStoredOrDissipated) {
  Pair pair(rolling_law());
  pair.stretch_to(-1e-4);
  const double start = pair.energy().elastic, slid = pair.sliding;
  const Vec3 axis = Vec3(1, 3, 2).normalized();
  double work = 0;
  const int count = 4000;
  const double each = 1e-3 / count;
  pair.hold(1, Vec3::Zero(), axis * (each / pair.options.time_step));
  for (int n = 0; n < count; ++n) {
    const Vec3 before = pair.moment(1);
    pair.step();
    work -= 0.5 * (before + pair.moment(1)).dot(axis) * each;
  }
  ASSERT_GT(pair.sliding - slid, 0.1 * work) << "it yields";
  EXPECT_NEAR(pair.energy().elastic - start + pair.sliding - slid, work, 1e-3 * work);
}

TEST(MomentTransfer, CohesionFallsLinearlyWithSlipToNothingAndFrictionStays) {
  dem::LinkLaw law = with_moments(plain_law());
  law.tensile_strength = 1e15;
  Pair pair(law);
  pair.stretch_to(-1e-5);
  const double whole = law.cohesion * Pair::area;
  const double reach = law.slip_softening * whole / pair.ks();  // slip at which it is gone [m]
  int gone = 0, seen = 0;
  pair.move(Vec3(0, 1.6 * reach, 0), 8000, [&] {
    const double slip = pair.assembly.links.slip[0] * Pair::distance;
    if (slip == 0) return;
    const double left = std::max(0.0, 1 - slip / reach);
    const double limit = whole * left + pair.normal() * law.internal_slope;
    ASSERT_NEAR(pair.shear().norm(), std::max(0.0, limit), 1e-3 * whole) << slip / reach;
    ++seen, gone += left == 0;
  });
  EXPECT_GT(seen, 4000);
  EXPECT_GT(gone, 500);
  EXPECT_EQ(dem::broken_links(law, pair.assembly.links), 0u);
  pair.stretch_to(-1e-5, 4000);
  pair.move(Vec3(0, -0.5 * reach, 0), 4000);
  pair.stretch_to(-1e-5, 4000);
  EXPECT_NEAR(pair.shear().norm(), pair.normal() * law.internal_slope, 1e-3 * whole) << "friction stays";
}

TEST(MomentTransfer, KeepsItsCohesionWhereSlipSofteningIsZero) {
  dem::LinkLaw law = with_moments(plain_law());
  law.slip_softening = 0;
  law.tensile_strength = 1e15;
  Pair pair(law);
  const double whole = law.cohesion * Pair::area;
  pair.move(Vec3(0, 30 * whole / pair.ks(), 0), 3000);
  EXPECT_NEAR(pair.shear().norm(), whole + pair.normal() * law.internal_slope, 1e-3 * whole);
  EXPECT_GT(pair.shear().norm(), 0.5 * whole);
}

TEST(MomentTransfer, LedgerOfAShatteringClusterClosesAndMomentaStay) {
  dem::Assembly made = scene::cluster(120, with_moments(plain_law()), 21);
  scene::shake(made.particles, 3, 22);
  const double dt = 0.05 * scene::critical_step_of(made);
  scene::Scene scene(std::move(made), dt);
  const auto angular = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < scene.particles().count; ++i) {
      const dem::Kinematics& k = scene.particles().kinematics[i];
      sum += scene.particles().element_mass(i) * k.position().cross(k.velocity()) +
             scene.particles().element_inertia(i) * k.spin();
    }
    return sum;
  };
  double start = 0, scale = 0;
  for (std::size_t i = 0; i < scene.particles().count; ++i) {
    const dem::Kinematics& k = scene.particles().kinematics[i];
    start += 0.5 * scene.particles().element_mass(i) * k.velocity().squaredNorm() +
             0.5 * scene.particles().element_inertia(i) * k.spin().squaredNorm();
    scale += scene.particles().element_mass(i) * k.position().norm() * k.velocity().norm();
  }
  const Vec3 before = angular();
  scene.steps(16000);
  const dem::PairEnergy energy = scene.energy();
  EXPECT_GT(dem::broken_links(scene.assembly.law, scene.assembly.links), 30u);
  EXPECT_GT(scene.sliding, 0.02 * start);
  EXPECT_NEAR(scene.kinetic + energy.elastic + energy.softening + scene.sliding, start, 0.01 * start);
  EXPECT_LT((angular() - before).norm(), 1e-12 * scale);
}

TEST(MomentTransfer, WithAllItsNumbersZeroIsThePapersLaw) {
  dem::LinkLaw with = plain_law();
  with.transfers_moments = true;
  with.slip_softening = 0;
  with.moment = {};
  const auto run = [](const dem::LinkLaw& law) {
    dem::Assembly made = scene::cluster(120, law, 5);
    scene::shake(made.particles, 3, 6);
    const double dt = 0.2 * scene::critical_step_of(made);
    scene::Scene scene(std::move(made), dt);
    scene.steps(300);
    return scene;
  };
  const scene::Scene one = run(plain_law()), two = run(with);
  ASSERT_GT(dem::broken_links(one.assembly.law, one.assembly.links), 0u);
  for (std::size_t i = 0; i < one.assembly.particles.count; ++i)
    EXPECT_LT((one.position(i) - two.position(i)).norm(), 1e-12) << i;
  EXPECT_NEAR(two.sliding, one.sliding, 1e-9 * one.sliding);
}

TEST(MomentTransfer, RollingShortensTheCriticalStepOfTwoSpheresAsTheirClosedFormSays) {
  dem::LinkLaw law = rolling_law();
  law.shear_ratio = 1e-6;
  law.moment.rolling_stiffness = 50;  // so much that turning is the fastest motion
  const Pair pair(law);
  const dem::Particles& p = pair.assembly.particles;
  const double stiffness = 50 * pair.kn() * radius_squared();
  const double expected = 2 / std::sqrt(stiffness * (1 / p.element_inertia(0) + 1 / p.element_inertia(1)));
  EXPECT_NEAR(scene::critical_step_of(pair.assembly), expected, 1e-5 * expected);
}
