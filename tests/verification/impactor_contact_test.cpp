// One element against an impactor, in closed form: restitution, duration, friction, continuity.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/verification/impactor_scene.h"

using impact::Nearest;
using impact::Shape;
using impact::Vec3;
using impactor_scene::Collision;
using impactor_scene::collision;
using std::numbers::pi;

namespace {

constexpr double radius = 0.01, element_mass = 0.03;

/// The shapes, each with points that see a face, an edge, a corner, a nose.
struct Case {
  std::string name;
  Shape shape;
  std::vector<Vec3> seen_from;
};

std::vector<Case> cases() {
  const std::vector<Vec3> around_box = {{0, 0, 1},    {0.1, 0.05, -1}, {0, 1, 1},
                                        {0.1, -1, 1}, {1, 1, 1},       {-1, 1, -1}};
  const std::vector<Vec3> around_round = {{0, 0, 1}, {0.3, 0.1, 1}, {1, 0.2, 0.02}, {1, -1, -1}, {0.03, 0, -1}};
  return {{"box", impact::make_box({0.3, 0.3, 0.3}, "test"), around_box},
          {"mesh", impact::make_mesh(impactor_scene::box_surface({0.15, 0.15, 0.15}).mesh()), around_box},
          {"sphere", impact::make_sphere(0.3, "test"), around_round},
          {"flat nose", impact::make_cylinder(0.2, 0.3, impact::Nose::flat, "test"), around_round},
          {"round nose", impact::make_cylinder(0.2, 0.3, impact::Nose::hemisphere, "test"), around_round}};
}

/// Where the element will strike: point and normal in space, at rest.
struct Strike {
  Vec3 point, normal;
};

/// One element that flies at the impactor's surface point nearest to `seen_from`, with `speed` along the normal
/// and `across` along a tangent. It starts half a step's way before it touches.
Strike aim(Collision& c, const Vec3& seen_from, double speed, double across, double time_step) {
  const Nearest target = impact::nearest(c.impactor.shape, seen_from);
  const impact::Pose pose = impact::pose_of(c.state.motion);
  Strike strike{pose.to_space(target.point), pose.orientation * target.normal};
  const Vec3 tangent = strike.normal.unitOrthogonal();
  const std::vector<Vec3> centre = {strike.point + (radius + 0.5 * time_step * speed) * strike.normal -
                                    0.5 * time_step * across * tangent};
  const std::vector<double> radii = {radius};
  c.particles = dem::Particles(centre, radii, element_mass);
  c.particles.set_velocity(0, -speed * strike.normal + across * tangent);
  c.step_options.time_step = time_step;
  return strike;
}

/// Steps until the element has left again; returns for how long it touched [s].
double bounce(Collision& c) {
  int touched = 0;
  for (int n = 0; n < 100000; ++n) {
    c.step();
    if (c.last.touching > 0) ++touched;
    if (touched > 0 && c.last.touching == 0) break;
  }
  return touched * c.step_options.time_step;
}

double stiffness_of(const Collision& c) { return c.impactor.law.normal_stiffness(radius); }

}  // namespace

TEST(ImpactorContact, BouncesLikeTwoBodies) {
  dem::Random random(1);
  for (const Case& one : cases())
    for (const Vec3& from : one.seen_from) {
      SCOPED_TRACE(one.name + " seen from " + std::to_string(from.x()) + " " + std::to_string(from.y()) + " " +
                   std::to_string(from.z()));
      // A light impactor, so that its mass and its turning count.
      Collision c = collision(one.shape, 10, impactor_scene::random_turn(random));
      const double k = stiffness_of(c), speed = 0.01;
      const double dt = pi * std::sqrt(element_mass / k) / 2000;
      const Strike strike = aim(c, from, speed, 0, dt);
      const dem::Mat3 turn = c.state.motion.orientation.toRotationMatrix();
      const dem::Mat3 inverse_inertia = turn * c.impactor.body.inverse_inertia * turn.transpose();
      const Vec3 arm = strike.point.cross(strike.normal);
      const double effective =
          1 / (1 / element_mass + 1 / c.impactor.body.mass + arm.dot(inverse_inertia * arm));

      const double duration = bounce(c);
      EXPECT_NEAR(duration / (pi * std::sqrt(effective / k)), 1, 2e-3);
      const Vec3 impulse = 2 * effective * speed * strike.normal;  // on the element
      const Vec3 expected = -speed * strike.normal + impulse / element_mass;
      EXPECT_LT((c.particles.kinematics[0].velocity() - expected).norm(), 2e-5 * speed);
      EXPECT_LT((c.state.motion.velocity + impulse / c.impactor.body.mass).norm(), 2e-5 * speed);
      EXPECT_LT((c.state.motion.angular_momentum + strike.point.cross(impulse)).norm(),
                2e-5 * impulse.norm() * 0.3);
      EXPECT_LT(c.particles.kinematics[0].spin().norm(), 1e-12 * speed / radius);
      EXPECT_NEAR(c.energy(), 0.5 * element_mass * speed * speed, 1e-6 * element_mass * speed * speed);
      EXPECT_EQ(c.damped, 0);
    }
}

TEST(ImpactorContact, DashpotRestitutesAsInClosedForm) {
  for (const double ratio : {0.02, 0.1, 0.3}) {
    Collision c = collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 10, Eigen::Quaterniond::Identity());
    c.impactor.law.damping_ratio = ratio;
    const double speed = 0.01, dt = pi * std::sqrt(element_mass / stiffness_of(c)) / 20000;
    const double effective = 1 / (1 / element_mass + 1 / c.impactor.body.mass);
    aim(c, {0, 0, 1}, speed, 0, dt);
    bounce(c);
    // A damped oscillator that lets go when the force has fallen to zero (Schwager and Poeschel, Granular
    // Matter 9 (2007) 465): at the phase a of the damped frequency.
    const double root = std::sqrt(1 - ratio * ratio), a = std::atan2(2 * ratio * root, 2 * ratio * ratio - 1);
    const double restitution = -std::exp(-ratio / root * a) * (std::cos(a) - ratio / root * std::sin(a));
    const double lost = 0.5 * effective * speed * speed * (1 - restitution * restitution);
    EXPECT_NEAR((c.particles.kinematics[0].vz - c.state.motion.velocity.z()) / speed, restitution, 2e-4)
        << ratio;
    EXPECT_NEAR(c.damped / lost, 1, 2e-3) << ratio;
    EXPECT_NEAR(c.energy() / (0.5 * element_mass * speed * speed), 1, 1e-6) << ratio;
  }
}

TEST(ImpactorContact, HertzTakesItsTime) {
  Collision c = collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 2500, Eigen::Quaterniond::Identity(),
                          {true, true, true, true, true, true});
  c.impactor.law.spring = impact::NormalSpring::hertz;
  const double speed = 1, factor = 4.0 / 3 * c.impactor.law.modulus * std::sqrt(radius);
  // Deepest (5 m v^2 / 4 K)^(2/5), for 2.9432751... times deepest/v (Landau and Lifshitz, Elasticity, section
  // 9).
  const double deepest = std::pow(1.25 * element_mass * speed * speed / factor, 0.4);
  const double expected = 2 * std::sqrt(pi) * std::tgamma(0.4) / (5 * std::tgamma(0.9)) * 2 * deepest / speed;
  aim(c, {0, 0, 1}, speed, 0, expected / 4000);
  double most = 0;
  int touched = 0;
  for (int n = 0; n < 6000; ++n) {
    c.step();
    most = std::max(most, c.last.deepest_overlap);
    touched += c.last.touching > 0;
  }
  EXPECT_NEAR(most / deepest, 1, 1e-5);
  EXPECT_NEAR(touched * c.step_options.time_step / expected, 1, 2e-3);
  EXPECT_NEAR(c.particles.kinematics[0].vz, speed, 1e-5);
}

TEST(ImpactorContact, GivenStiffnessTakesThePlaceOfTheModulus) {
  Collision c = collision(impact::make_sphere(0.3, "test"), 2500, Eigen::Quaterniond::Identity(),
                          {true, true, true, true, true, true});
  c.impactor.law.stiffness = 3e7;
  const double duration = pi * std::sqrt(element_mass / 3e7);
  aim(c, {0, 0, 1}, 0.1, 0, duration / 2000);
  EXPECT_NEAR(bounce(c) / duration, 1, 2e-3);
}

TEST(ImpactorContact, SlidesThroughAnObliqueImpact) {
  // Friction at its limit from first to last touch: the tangential impulse is mu times the normal one, wherever
  // the tangential velocity is high enough, here 20 times mu times the normal one.
  for (const Vec3& from : {Vec3(0.02, 0.01, 1), Vec3(0, 1, 1), Vec3(1, 1, 1)}) {
    Collision c = collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 2500, Eigen::Quaterniond::Identity(),
                            {true, true, true, true, true, true});
    c.impactor.law.friction = 0.3;
    c.impactor.law.shear_ratio = 0.5;
    const double speed = 0.001, across = 6 * speed, dt = pi * std::sqrt(element_mass / stiffness_of(c)) / 5000;
    const Strike strike = aim(c, from, speed, across, dt);
    const Vec3 tangent = strike.normal.unitOrthogonal();
    bounce(c);
    const dem::Kinematics& k = c.particles.kinematics[0];
    EXPECT_NEAR(k.velocity().dot(strike.normal) / speed, 1, 1e-4);
    EXPECT_NEAR((across - k.velocity().dot(tangent)) / (2 * 0.3 * speed), 1, 1e-4);
    const double inertia = 0.4 * element_mass * radius * radius;
    const Vec3 spin = radius / inertia * (2 * 0.3 * speed * element_mass) * strike.normal.cross(tangent);
    EXPECT_LT((k.spin() - spin).norm(), 2e-4 * spin.norm());
    EXPECT_NEAR(c.energy() / (0.5 * element_mass * (speed * speed + across * across)), 1, 1e-6);
    const Vec3 impulse = element_mass * (k.velocity() - (-speed * strike.normal + across * tangent));
    EXPECT_LT((c.state.motion.support_impulse - impulse).norm(), 1e-12 * impulse.norm());
  }
}

TEST(ImpactorContact, SticksThroughAnObliqueImpact) {
  // With endless friction the contact point swings on the tangential spring, with k_t (1/m + R^2/I) = 7/2
  // k_t/m, for half a period of the normal spring; what the tangential spring then still holds is lost.
  for (const double ratio : {0.1, 2.0 / 7, 0.7}) {
    Collision c = collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 2500, Eigen::Quaterniond::Identity(),
                            {true, true, true, true, true, true});
    c.impactor.law.friction = 1e9;
    c.impactor.law.shear_ratio = ratio;
    const double speed = 0.001, across = 0.0004;
    const Strike strike =
        aim(c, {0, 0, 1}, speed, across, pi * std::sqrt(element_mass / stiffness_of(c)) / 20000);
    const Vec3 tangent = strike.normal.unitOrthogonal();
    bounce(c);
    const double phase = pi * std::sqrt(3.5 * ratio);
    const double impulse = element_mass / 3.5 * across * (1 - std::cos(phase));
    EXPECT_NEAR((across - c.particles.kinematics[0].velocity().dot(tangent)) * element_mass / impulse, 1, 1e-3)
        << ratio;
    const double held = 0.5 * element_mass / 3.5 * across * across * std::pow(std::sin(phase), 2);
    EXPECT_NEAR(c.sliding, held, 1e-3 * 0.5 * element_mass / 3.5 * across * across) << ratio;
    EXPECT_NEAR(c.energy() / (0.5 * element_mass * (speed * speed + across * across)), 1, 1e-6) << ratio;
  }
}

TEST(ImpactorContact, ForceIsContinuousOverFacesEdgesAndCorners) {
  // An element drawn along a line beside a turning box passes over faces, edges and near corners; the force may
  // change by no more than stiffness times what can change in a step.
  for (const Shape& shape : {Shape(impact::make_box({0.3, 0.2, 0.1}, "test")),
                             Shape(impact::make_mesh(impactor_scene::box_surface({0.15, 0.1, 0.05}).mesh())),
                             Shape(impact::make_cylinder(0.2, 0.3, impact::Nose::hemisphere, "test")),
                             Shape(impact::make_cylinder(0.2, 0.3, impact::Nose::flat, "test"))}) {
    dem::Random random(23);
    for (int line = 0; line < 20; ++line) {
      const Vec3 direction = impactor_scene::random_vector(random, 1).normalized();
      // Just outside of the surface all the way: pushed out of it where the line goes through.
      Vec3 on_line =
          impact::nearest(shape, 10 * impactor_scene::random_vector(random, 1)).point - 0.15 * direction;
      Vec3 before = Vec3::Zero();
      Vec3 place_before = Vec3::Zero();
      for (int n = 0; n < 3000; ++n) {
        on_line += 1e-4 * direction;
        const Nearest near = impact::nearest(shape, on_line);
        const Vec3 centre = near.distance > 0.8 * radius ? on_line : near.point + 0.8 * radius * near.normal;
        const Nearest here = impact::nearest(shape, centre);
        const Vec3 force = std::max(0.0, radius - here.distance) * here.normal;
        // |d(u n)| <= |dx| (1 + u/phi) outside of a convex shape, u <= 0.2 R and phi >= 0.8 R.
        if (n > 0) {
          ASSERT_LE((force - before).norm(), 1.2501 * (centre - place_before).norm() + 1e-12);
        }
        before = force, place_before = centre;
      }
    }
  }
}

namespace {

/// Element and impactor turn together once about a far axis, in `count` steps, pressed together, with a shear
/// force from before. Returns by how much that is off when it has come round, as a slip over the way gone [-].
double slip_of_one_turn(int count) {
  Collision c = collision(impact::make_box({0.3, 0.3, 0.3}, "test"), 2500, Eigen::Quaterniond::Identity());
  c.impactor.law.friction = 1;
  const Vec3 axis = Vec3(1, 2, -1).normalized(), pivot(0.4, -0.3, 0.2);
  const double press = 1e-4, angle = 2 * pi / count, dt = 1e-6;
  const Vec3 start(0.02, 0.03, 0.15 + radius - press);
  const std::vector<Vec3> centres = {start};
  const std::vector<double> radii = {radius};
  c.particles = dem::Particles(centres, radii, element_mass);
  const double normal_force = stiffness_of(c) * press;
  const Vec3 shear(0.2 * normal_force, 0.1 * normal_force, 0);
  c.state.contacts = {{0, shear, Vec3::UnitZ(), 0}};
  const auto place = [&](const Vec3& x, double by) -> Vec3 {
    return pivot + Eigen::AngleAxisd(by, axis) * (x - pivot);
  };
  for (int n = 0; n < count; ++n) {
    // Both go from one place of their circles to the next.
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(n * angle, axis));
    const Vec3 middle = place(Vec3::Zero(), n * angle), x = place(start, n * angle);
    c.state.motion = impact::start_motion(
        c.impactor.body, middle, turn, (place(Vec3::Zero(), (n + 1) * angle) - middle) / dt, angle / dt * axis);
    dem::Kinematics& k = c.particles.kinematics[0];
    k.x = x.x(), k.y = x.y(), k.z = x.z();
    c.particles.set_velocity(0, (place(start, (n + 1) * angle) - x) / dt, angle / dt * axis);
    c.step_options.time_step = dt;
    c.last = impact::advance_impactor(c.impactor, c.state, c.room, c.particles, c.step_options, c.loads);
    EXPECT_EQ(c.last.touching, 1u);
    EXPECT_EQ(c.last.sliding, 0);
    EXPECT_NEAR(c.last.deepest_overlap, press, 1e-10);
    if (testing::Test::HasFailure()) break;
  }
  return (c.state.contacts.at(0).shear - shear).norm() / c.impactor.law.tangential_stiffness(radius) /
         (2 * pi * start.norm());
}

}  // namespace

TEST(ImpactorContact, RigidRotationLeavesNoShear) {
  // The friction spring turns along and gets nothing from the rotation but the error of a chord for an arc.
  const double coarse = slip_of_one_turn(2000), fine = slip_of_one_turn(4000);
  EXPECT_LT(coarse, 1e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}
