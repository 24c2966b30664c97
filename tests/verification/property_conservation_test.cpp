// What every assembly keeps, whatever its elements, links and law: momenta, energy, and its way as another
// observer sees it.
#include <Eigen/Geometry>

#include "tests/verification/property_scene.h"

using dem::Mat3;
using dem::Vec3;
using property::assemblies;
using property::Parts;
using property::Seen;
using scene::Scene;

namespace {

class Assemblies : public testing::TestWithParam<property::Kind> {};
INSTANTIATE_TEST_SUITE_P(All, Assemblies, property::all_kinds, property::name_of);

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linear_scale = 0, angular_scale = 0;
};

Momenta momenta_of(const dem::Particles& particles) {
  Momenta sum;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics& k = particles.kinematics[i];
    const double m = particles.element_mass(i), inertia = particles.element_inertia(i);
    sum.linear += m * k.velocity();
    sum.angular += m * k.position().cross(k.velocity()) + inertia * k.spin();
    sum.linear_scale += m * k.velocity().norm();
    sum.angular_scale += m * k.position().norm() * k.velocity().norm() + inertia * k.spin().norm();
  }
  return sum;
}

double kinetic_of(const dem::Particles& particles) {
  double sum = 0;
  for (std::size_t i = 0; i < particles.count; ++i)
    sum += 0.5 * (particles.element_mass(i) * particles.kinematics[i].velocity().squaredNorm() +
                  particles.element_inertia(i) * particles.kinematics[i].spin().squaredNorm());
  return sum;
}

/// What the ledger lacks after `steps` steps of the assembly's time step times `fraction`, over the energy at
/// the start. The start counts as half a step later: the velocities are those of its middle.
double imbalance(const Parts& parts, double fraction, Seen* seen) {
  Scene scene = parts.scene();
  scene.options.time_step *= fraction;
  const double start = kinetic_of(scene.particles());
  scene.steps(static_cast<int>(property::steps / fraction));
  if (seen != nullptr) seen->add(scene);
  const dem::PairEnergy energy = scene.energy();
  return std::abs(scene.kinetic + energy.elastic + energy.softening + scene.sliding - start) / start;
}

Mat3 any_turn(dem::Random& random) {
  const double angle = random.uniform(0.3, 3);
  return Eigen::AngleAxisd(angle, property::any_vector(random, 1).normalized()).toRotationMatrix();
}

}  // namespace

TEST_P(Assemblies, KeepTheirMomenta) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scene scene = property::any_parts(seed, GetParam()).scene();
    const Momenta before = momenta_of(scene.particles());
    scene.steps(property::steps);
    seen.add(scene);
    const Momenta after = momenta_of(scene.particles());
    ASSERT_LT((after.linear - before.linear).norm(), 1e-13 * before.linear_scale);
    ASSERT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular_scale);
  }
  seen.expect_of(GetParam());
}

// The leapfrog's ledger closes to the order of the step: what is missing shrinks with it.
TEST_P(Assemblies, KeepTheirEnergyTheBetterTheSmallerTheStep) {
  Seen seen;
  double coarse = 0, fine = 0;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Parts parts = property::any_parts(seed, GetParam());
    const double missing = imbalance(parts, 1, &seen);
    ASSERT_LT(missing, 0.02);
    coarse += missing, fine += imbalance(parts, 0.25, nullptr);
  }
  EXPECT_LT(fine, 0.4 * coarse);
  seen.expect_of(GetParam());
}

TEST_P(Assemblies, GoTheSameWayTurnedAndElsewhere) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, GetParam());
    Scene straight = parts.scene();
    dem::Random random(1000 + seed);
    const Mat3 turn = any_turn(random);
    const Vec3 shift = property::any_vector(random, 0.1);
    for (Vec3& x : parts.centres) x = turn * x + shift;
    for (auto* vectors : {&parts.velocities, &parts.spins})
      for (Vec3& v : *vectors) v = turn * v;
    Scene turned = parts.scene();
    property::expect_same_way(straight, turned, 1e-7, seen, [&](std::size_t i, const Vec3& x, double) {
      return std::pair(i, Vec3(turn * x + shift));
    });
    // The forces turn along.
    double largest = 0;
    for (std::size_t i = 0; i < straight.particles().count; ++i)
      largest = std::max(largest, straight.force(i).norm());
    for (std::size_t i = 0; i < straight.particles().count; ++i)
      ASSERT_LE((turned.force(i) - turn * straight.force(i)).norm(), 1e-4 * largest) << "element " << i;
  }
  seen.expect_of(GetParam());
}

TEST_P(Assemblies, GoTheSameWayToWhoeverDrivesPast) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, GetParam());
    Scene resting = parts.scene();
    dem::Random random(2000 + seed);
    const Vec3 wind = property::any_vector(random, 5);
    for (Vec3& v : parts.velocities) v += wind;
    Scene moving = parts.scene();
    property::expect_same_way(resting, moving, 1e-7, seen, [&](std::size_t i, const Vec3& x, double time) {
      return std::pair(i, Vec3(x + time * wind));
    });
  }
  seen.expect_of(GetParam());
}

// Without shear nothing remembers the way, so turning time round leads back to the start.
TEST(ElasticAssemblies, GoBackWhenTimeIsTurnedRound) {
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, {false, true});
    parts.law.tensile_strength = parts.law.cohesion = 1e15;
    parts.law.shear_ratio = parts.law.internal_slope = parts.law.contact_slope = 0;
    Scene scene = parts.scene();
    scene.steps(property::steps);
    const double way = property::farthest(scene);
    // Velocities are those between two positions: the last half of the way is gone before turning round.
    for (std::size_t i = 0; i < scene.particles().count; ++i) {
      dem::Kinematics& k = scene.particles().kinematics[i];
      const Vec3 ahead = k.position() + scene.options.time_step * k.velocity();
      k.x = ahead.x(), k.y = ahead.y(), k.z = ahead.z();
      scene.particles().set_velocity(i, -k.velocity(), -k.spin());
    }
    scene.steps(property::steps);
    for (std::size_t i = 0; i < scene.particles().count; ++i) {
      const Vec3 start = parts.centres[i] + scene.options.time_step * parts.velocities[i];
      ASSERT_LT((scene.position(i) - start).norm(), 1e-9 * way) << "element " << i;
    }
  }
}
