// Impactor and many elements: momentum, energy, bits that do not depend on lists or stops, cost.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "tests/verification/impactor_scene.h"

using impact::Shape;
using impact::Vec3;
using impactor_scene::Collision;

namespace {

/// A tumbling impactor amid a cloud of elements that fly about, with friction and a dashpot.
Collision storm(Shape shape, std::uint64_t seed, double damping = 0.1, double friction = 0.4) {
  dem::Random random(seed);
  std::vector<Vec3> centres;
  while (centres.size() < 800) {
    const Vec3 p = impactor_scene::random_vector(random, 0.32);
    if (impact::nearest(shape, p).distance > 0.016) centres.push_back(p);
  }
  std::vector<double> radii(centres.size());
  for (double& r : radii) r = random.uniform(0.01, 0.015);
  Collision c = impactor_scene::collision(std::move(shape), 300, Eigen::Quaterniond::Identity());
  c.impactor.law.modulus = 2e7;
  c.impactor.law.friction = friction;
  c.impactor.law.shear_ratio = 0.4;
  c.impactor.law.damping_ratio = damping;
  c.state.motion = impact::start_motion(c.impactor.body, Vec3::Zero(), Eigen::Quaterniond::Identity(),
                                        {1, -2, 3}, {5, 9, -4});
  c.particles = dem::Particles(centres, radii, 5);
  for (std::size_t i = 0; i < centres.size(); ++i)
    c.particles.set_velocity(i, impactor_scene::random_vector(random, 15),
                             impactor_scene::random_vector(random, 100));
  c.step_options.time_step = 1e-5;
  return c;
}

std::vector<Shape> shapes() {
  impactor_scene::Surface dented = impactor_scene::sphere_surface(0.2, 3);
  for (Vec3& v : dented.vertices) v *= 1 + 0.25 * std::sin(20 * v.x());
  return {impact::make_box({0.3, 0.2, 0.25}, "test"), impact::make_sphere(0.3, "test"),
          impact::make_cylinder(0.2, 0.4, impact::Nose::flat, "test"),
          impact::make_cylinder(0.2, 0.4, impact::Nose::hemisphere, "test"), impact::make_mesh(dented.mesh())};
}

bool same_bits(const Collision& a, const Collision& b) {
  const auto one = impact::to_numbers(a.state), other = impact::to_numbers(b.state);
  for (const auto& [name, column] : one) {
    const auto& match = other.at(name);
    if (column.size() != match.size() ||
        (!column.empty() && std::memcmp(column.data(), match.data(), column.size() * sizeof(double)) != 0))
      return false;
  }
  return std::memcmp(a.particles.kinematics.data(), b.particles.kinematics.data(),
                     a.particles.count * sizeof(dem::Kinematics)) == 0;
}

}  // namespace

TEST(ImpactorConservation, KeepsMomentumToRounding) {
  std::uint64_t seed = 1;
  for (Shape& shape : shapes()) {
    Collision c = storm(std::move(shape), seed++);
    const Vec3 linear = c.momentum(), angular = c.angular_momentum();
    double scale = 0, arms = 0;
    for (std::size_t i = 0; i < c.particles.count; ++i) {
      const dem::Kinematics& k = c.particles.kinematics[i];
      scale += c.particles.element_mass(i) * k.velocity().norm();
      arms += c.particles.element_mass(i) * k.position().norm() * k.velocity().norm();
    }
    std::size_t touched = 0;
    for (int n = 0; n < 2000; ++n) {
      c.step();
      touched += c.last.touching;
    }
    EXPECT_GT(touched, 1000u);
    EXPECT_LT((c.momentum() - linear).norm(), 1e-13 * scale) << seed;
    EXPECT_LT((c.angular_momentum() - angular).norm(), 1e-13 * arms) << seed;
  }
}

TEST(ImpactorConservation, LedgerCloses) {
  // The error is that of the step: it falls with its square where contacts are smooth.
  std::uint64_t seed = 11;
  for (Shape& shape : shapes()) {
    const bool concave = shape.index() == 4;
    double error[2] = {};
    for (int fine = 0; fine < 2; ++fine) {
      Collision c = storm(shape, seed);
      if (fine) c.step_options.time_step /= 4;
      c.step();
      const double before = c.energy();
      double worst = 0;
      for (int n = 0; n < (fine ? 8000 : 2000); ++n) {
        c.step();
        worst = std::max(worst, std::abs(c.energy() - before));
      }
      EXPECT_GT(c.sliding, 0.005 * before);
      EXPECT_GT(c.damped, 0.005 * before);
      error[fine] = worst / before;
    }
    ++seed;
    EXPECT_LT(error[0], 2e-3);
    // Over a dent the normal may jump within a step, which costs first order.
    EXPECT_LT(error[1], (concave ? 0.5 : 0.15) * error[0]);
  }
}

TEST(ImpactorConservation, ElasticContactsKeepEnergy) {
  for (Shape& shape : shapes()) {
    Collision c = storm(std::move(shape), 31, 0, 0);
    c.step_options.time_step = 2e-6;
    c.step();
    const double before = c.energy();
    for (int n = 0; n < 8000; ++n) c.step();
    EXPECT_NEAR(c.energy() / before, 1, 2e-5);
    EXPECT_EQ(c.sliding, 0);
    EXPECT_EQ(c.damped, 0);
  }
}

TEST(ImpactorConservation, BitsDoNotDependOnLists) {
  for (Shape& shape : shapes()) {
    Collision kept = storm(shape, 5), remade = storm(shape, 5);
    for (int n = 0; n < 1500; ++n) {
      kept.step();
      remade.room = {};
      remade.step();
    }
    EXPECT_TRUE(same_bits(kept, remade));
    EXPECT_LT(kept.room.rebuilds, 300u);
    EXPECT_LT(kept.room.looked_at, remade.room.looked_at * 1500);
  }
}

TEST(ImpactorConservation, GoesOnFromItsNumbers) {
  Collision through = storm(shapes()[0], 6);
  for (int n = 0; n < 700; ++n) through.step();
  Collision resumed = through;
  resumed.room = {};
  resumed.state = impact::from_numbers(impact::to_numbers(through.state), "test");
  ASSERT_FALSE(resumed.state.contacts.empty());
  for (int n = 0; n < 700; ++n) {
    through.step();
    resumed.step();
  }
  EXPECT_TRUE(same_bits(through, resumed));
}

TEST(ImpactorConservation, LooksOnlyAtElementsNearby) {
  // The paper's cube above a slab of small elements: of all of them a step looks at the few below the cube.
  std::vector<Vec3> centres;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 80; ++j)
      for (int k = 0; k < 12; ++k) centres.emplace_back(0.025 * i - 1.25, 0.025 * j - 1, -0.0125 - 0.025 * k);
  const std::vector<double> radii(centres.size(), 0.012);
  Collision c = impactor_scene::collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 2500,
                                          Eigen::Quaterniond::Identity());
  c.impactor.law.friction = 0.1;
  c.state.motion = impact::start_motion(c.impactor.body, {0, 0, 0.1502}, Eigen::Quaterniond::Identity(),
                                        {0, 0, -40}, Vec3::Zero());
  c.particles = dem::Particles(centres, radii, 3500);
  c.step_options.time_step = 2e-6;
  const int steps = 200;
  std::size_t most = 0;
  for (int n = 0; n < steps; ++n) {
    c.step();
    most = std::max(most, c.last.touching);
  }
  EXPECT_GE(most, 100u);
  EXPECT_LT(c.room.looked_at, 200u * steps);
  EXPECT_LT(c.room.rebuilds, 10u);
}
