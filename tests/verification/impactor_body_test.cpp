// A rigid body's free flight, its order, what locked degrees of freedom give back, and mass properties.
#include "impact/impactors/rigid_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdem/core/error.h"
#include "tests/verification/impactor_scene.h"

using impact::Mat3;
using impact::Motion;
using impact::RigidBody;
using impact::Vec3;

namespace {

/// Asymmetric, and its frame is not that of its principal axes.
RigidBody odd_body(const std::array<bool, 6>& locked = {}) {
  const impact::MassProperties plain =
      impact::from_density(impact::make_box({0.1, 0.2, 0.4}, "test"), 2500, "test");
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  return {{plain.mass, turn * plain.inertia * turn.transpose()}, locked, "test"};
}

Motion tumbling(const RigidBody& body) {
  return impact::start_motion(body, Vec3::Zero(), Eigen::Quaterniond::Identity(), {1, 2, 3}, {3, -5, 4});
}

/// Where it points after `time`, and how far its energy was off on the way.
struct Flight {
  Eigen::Quaterniond orientation;
  double energy_error = 0, last_energy_error = 0;
};

Flight fly(double time, int steps) {
  const RigidBody body = odd_body();
  Motion motion = tumbling(body);
  const double dt = time / steps;
  const double spinning = 0.5 * motion.spin.dot(motion.angular_momentum);
  Flight flight;
  for (int n = 0; n < steps; ++n) {
    impact::drift(body, motion, dt);
    const double now = impact::kick(body, motion, Vec3::Zero(), Vec3::Zero(), dt) - 7 * body.mass;
    flight.last_energy_error = now / spinning - 1;
    flight.energy_error = std::max(flight.energy_error, std::abs(flight.last_energy_error));
  }
  flight.orientation = motion.orientation;
  return flight;
}

}  // namespace

TEST(ImpactorBody, FreeFlightKeepsAngularMomentumExactly) {
  const RigidBody body = odd_body();
  Motion motion = tumbling(body);
  const Vec3 before = motion.angular_momentum;
  for (int n = 0; n < 20000; ++n) {
    impact::drift(body, motion, 1e-3);
    impact::kick(body, motion, Vec3::Zero(), Vec3::Zero(), 1e-3);
  }
  EXPECT_EQ(motion.angular_momentum, before);
  EXPECT_NEAR(motion.orientation.norm(), 1, 1e-15);
  EXPECT_LT((motion.position - 20 * Vec3(1, 2, 3)).norm(), 1e-10);
}

TEST(ImpactorBody, FreeFlightIsOfSecondOrder) {
  // Seven time units are some seven turns; the energy swings with dt^2 and does not drift.
  const Flight exact = fly(7, 64000);
  const Flight coarse = fly(7, 2000), fine = fly(7, 4000), long_one = fly(70, 20000);
  const double order = std::log2(coarse.orientation.angularDistance(exact.orientation) /
                                 fine.orientation.angularDistance(exact.orientation));
  EXPECT_NEAR(order, 2, 0.02);
  EXPECT_NEAR(std::log2(coarse.energy_error / fine.energy_error), 2, 0.02);
  EXPECT_LT(coarse.energy_error, 1e-4);
  EXPECT_LT(long_one.energy_error, 1.1 * coarse.energy_error);
}

TEST(ImpactorBody, ComesBackWhenTimeIsReversed) {
  const RigidBody body = odd_body();
  Motion motion = tumbling(body);
  for (int n = 0; n < 1000; ++n) impact::drift(body, motion, 1e-2);
  for (int n = 0; n < 1000; ++n) impact::drift(body, motion, -1e-2);
  EXPECT_LT(motion.orientation.angularDistance(Eigen::Quaterniond::Identity()), 1e-10);
}

TEST(ImpactorBody, PrecessesLikeASymmetricTop) {
  // The axis of a symmetric top goes round its angular momentum at L/I_across.
  const impact::Shape shape = impact::make_cylinder(0.1, 0.4, impact::Nose::flat, "test");
  const RigidBody body(impact::from_density(shape, 2500, "test"), {}, "test");
  Motion motion =
      impact::start_motion(body, Vec3::Zero(), Eigen::Quaterniond::Identity(), Vec3::Zero(), {4, 0, 20});
  const double around = motion.angular_momentum.norm() / body.inertia(0, 0);
  const double period = 2 * std::numbers::pi / around;
  for (int n = 0; n < 20000; ++n) impact::drift(body, motion, period / 20000);
  EXPECT_LT((motion.orientation * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-6);
}

TEST(ImpactorBody, MomentsAndForcesGiveTheirImpulses) {
  const RigidBody body = odd_body();
  Motion motion = tumbling(body);
  const Vec3 force(3, -1, 2), moment(0.2, 0.1, -0.3), angular = motion.angular_momentum;
  double work = 0, first = 0, last = 0;
  const double dt = 1e-4;
  for (int n = 0; n < 5000; ++n) {
    const Vec3 v = motion.velocity, w = motion.spin;
    impact::drift(body, motion, dt);
    if (n > 0) work += dt * (force.dot(v) + moment.dot(motion.spin));
    (void)w;
    last = impact::kick(body, motion, force, moment, dt);
    if (n == 0) first = last;
  }
  EXPECT_LT((motion.velocity - Vec3(1, 2, 3) - 5000 * dt / body.mass * force).norm(), 1e-12);
  EXPECT_LT((motion.angular_momentum - angular - 5000 * dt * moment).norm(), 1e-12);
  EXPECT_NEAR(last - first, work, 1e-6 * work);
}

TEST(ImpactorBody, LockedFreedomsKeepTheirVelocityAndReportWhatTheyGive) {
  const RigidBody body = odd_body({true, false, false, false, true, false});
  Motion motion = tumbling(body);
  const Vec3 force(5, 1, 0), moment(1, 2, 3), angular = motion.angular_momentum;
  const double dt = 1e-4;
  double first = 0, last = 0, work = 0, support_before = 0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 v = motion.velocity;
    impact::drift(body, motion, dt);
    if (n > 0) work += dt * (force.dot(v) + moment.dot(motion.spin));
    last = impact::kick(body, motion, force, moment, dt);
    if (n == 0) first = last, support_before = motion.support_work;
  }
  EXPECT_EQ(motion.velocity.x(), 1);
  EXPECT_EQ(motion.spin.y(), -5);
  EXPECT_NEAR(motion.velocity.y(), 2 + 4000 * dt / body.mass, 1e-12);
  EXPECT_NEAR(motion.support_impulse.x(), -4000 * dt * 5, 1e-12);
  // Impulse of moment and support together is the change of angular momentum; the other axes get nothing.
  EXPECT_LT((motion.angular_momentum - angular - 4000 * dt * moment - motion.support_angular_impulse).norm(),
            1e-11);
  EXPECT_EQ(motion.support_angular_impulse.x(), 0);
  // First and last energies are half a step off the work of the support: first order in dt.
  EXPECT_NEAR(last - first, work + motion.support_work - support_before, 2e-3 * std::abs(last - first));
}

TEST(ImpactorBody, RefusesToTurnTooFarInAStep) {
  const RigidBody body = odd_body();
  Motion motion = tumbling(body);
  EXPECT_THROW(
      {
        for (int n = 0; n < 10; ++n) impact::drift(body, motion, 5.0);
      },
      dem::RunError);
}

TEST(ImpactorBody, MassPropertiesOfACappedCylinderAgreeWithItsTriangles) {
  // A surface of revolution with many sides; volume and inertia converge with the square of the side.
  const impact::Cylinder shape = impact::make_cylinder(0.2, 0.5, impact::Nose::hemisphere, "test");
  const impact::Filled exact = impact::filled(impact::Shape(shape));
  const auto error_with = [&](int sides) {
    std::vector<std::pair<double, double>> outline;  // (rho, z) from back to tip, without the ends on the axis
    outline.emplace_back(0.1, shape.back);
    for (int k = 0; k < sides; ++k) {
      const double angle = 0.5 * std::numbers::pi * k / sides;
      outline.emplace_back(0.1 * std::cos(angle), shape.front - 0.1 + 0.1 * std::sin(angle));
    }
    impactor_scene::Surface s;
    s.vertices = {{0, 0, shape.back}, {0, 0, shape.front}};
    const int around = 4 * sides, rings = static_cast<int>(outline.size());
    for (const auto& [rho, z] : outline)
      for (int a = 0; a < around; ++a) {
        const double angle = 2 * std::numbers::pi * a / around;
        s.vertices.emplace_back(rho * std::cos(angle), rho * std::sin(angle), z);
      }
    for (int a = 0; a < around; ++a) {
      const int next = (a + 1) % around;
      s.triangles.push_back({0, 2 + next, 2 + a});
      for (int r = 0; r + 1 < rings; ++r) {
        const int low = 2 + r * around, high = low + around;
        s.triangles.push_back({low + a, low + next, high + next});
        s.triangles.push_back({low + a, high + next, high + a});
      }
      const int top = 2 + (rings - 1) * around;
      s.triangles.push_back({top + a, top + next, 1});
    }
    const impact::Filled found = impact::filled(s.mesh());
    return std::array{found.volume / exact.volume - 1, found.centre.norm() / shape.radius,
                      (found.inertia - exact.inertia).norm() / exact.inertia.norm()};
  };
  const auto coarse = error_with(16), fine = error_with(32);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(std::abs(fine[k]), 2e-3);
    EXPECT_NEAR(std::log2(std::abs(coarse[k] / fine[k])), 2, 0.05) << k;
  }
}
