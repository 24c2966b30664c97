// What the step must keep: momentum, energy, and the physics under another numbering or in another frame.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "libdem/probe/damage.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/uniaxial.h"
#include "tests/verification/scene.h"

using dem::Mat3;
using dem::Vec3;
using scene::Scene;

namespace {

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linear_scale = 0, angular_scale = 0;  ///< sums of the absolute values
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

void rotate(dem::Assembly& assembly, const Mat3& turn) {
  dem::Particles& p = assembly.particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    dem::Kinematics& k = p.kinematics[i];
    const Vec3 x = turn * k.position(), v = turn * k.velocity(), w = turn * k.spin();
    k.x = x.x(), k.y = x.y(), k.z = x.z();
    p.set_velocity(i, v, w);
    p.rotation[i] = turn * p.rotation[i];
    p.initial_position[i] = turn * p.initial_position[i];
  }
  for (dem::Links* links : {&assembly.links, &assembly.contacts})
    for (std::size_t k = 0; k < links->count; ++k) {
      const Vec3 shear = turn * Vec3(links->shear_x[k], links->shear_y[k], links->shear_z[k]);
      links->shear_x[k] = shear.x(), links->shear_y[k] = shear.y(), links->shear_z[k] = shear.z();
    }
}

Mat3 some_rotation() { return Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.7).normalized()).toRotationMatrix(); }

/// A shaken cluster in which links soften, slide and break and debris meets.
Scene shattering(std::uint64_t seed, double speed = 3) {
  dem::Assembly made = scene::cluster(120, scene::plain_law(), seed);
  scene::shake(made.particles, speed, seed + 1);
  const double dt = 0.2 * scene::critical_step_of(made);
  return {std::move(made), dt};
}

/// The whole assembly turns as a rigid body about an axis through the origin: every element goes from one place
/// of its circle to the next in each step.
void turn_rigidly(Scene& scene, const Vec3& axis, double angle, int count) {
  const double each = angle / count, dt = scene.options.time_step;
  const Mat3 turn = Eigen::AngleAxisd(each, axis).toRotationMatrix();
  for (int n = 0; n < count; ++n) {
    for (std::size_t i = 0; i < scene.particles().count; ++i) {
      const Vec3 x = scene.position(i);
      scene.hold(i, (turn * x - x) / dt, each / dt * axis);
    }
    scene.step();
  }
}

}  // namespace

TEST(Momentum, LinearAndAngularStayToRoundingWhileLinksBreakAndDebrisMeets) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Scene scene = shattering(seed);
    const Momenta before = momenta_of(scene.particles());
    scene.steps(4000);
    const Momenta after = momenta_of(scene.particles());
    EXPECT_GT(dem::broken_links(scene.assembly.law, scene.assembly.links), 50u);
    double contacts = 0;
    for (std::size_t k = 0; k < scene.assembly.contacts.count; ++k)
      contacts += std::abs(scene.assembly.contacts.shear_x[k]);
    EXPECT_GT(contacts + static_cast<double>(scene.assembly.contacts.count), 0);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-13 * before.linear_scale);
    EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular_scale);
  }
}

TEST(Energy, OfAnElasticFreeVibrationDriftsByLessThanOnePartInAMillionInTenThousandSteps) {
  dem::Assembly made = scene::cluster(60, scene::elastic_law(), 5);
  scene::shake(made.particles, 1e-3, 6);  // strains of 1e-6: the leapfrog's own energy is then exact
  const double dt = 0.5 * scene::critical_step_of(made);
  Scene scene(std::move(made), dt);
  // The step starts in the middle of a kick: the ledger's energy is known from the first step on.
  scene.step();
  const double start = scene.kinetic + scene.energy().elastic;
  double worst = 0, largest_elastic = 0;
  for (int n = 0; n < 10000; ++n) {
    scene.step();
    const double elastic = scene.energy().elastic;
    worst = std::max(worst, std::abs(scene.kinetic + elastic - start));
    largest_elastic = std::max(largest_elastic, elastic);
  }
  EXPECT_GT(largest_elastic, 0.3 * start) << "it vibrates";
  EXPECT_EQ(scene.sliding, 0);
  EXPECT_LT(worst, 1e-6 * start);
}

TEST(Energy, LedgerOfAShatteringClusterCloses) {
  Scene scene = shattering(7);
  double start = 0;
  for (std::size_t i = 0; i < scene.particles().count; ++i) {
    const dem::Kinematics& k = scene.particles().kinematics[i];
    start += 0.5 * scene.particles().element_mass(i) * k.velocity().squaredNorm() +
             0.5 * scene.particles().element_inertia(i) * k.spin().squaredNorm();
  }
  scene.options.damping = {0.1, 1e-3, 0.1};
  scene.options.time_step *= 0.25;
  scene.steps(16000);
  const dem::PairEnergy energy = scene.energy();
  EXPECT_GT(energy.softening, 0.01 * start);
  EXPECT_GT(scene.sliding, 0.01 * start);
  EXPECT_GT(scene.damped, 0.01 * start);
  EXPECT_NEAR(scene.kinetic + energy.elastic + energy.softening + scene.sliding + scene.damped, start,
              0.01 * start);
}

TEST(Numbering, DoesNotChangeTheCurveBeforeBreakage) {
  specimens::PackingOptions packing;
  packing.size = Vec3(0.25, 0.25, 0.25);
  packing.elements = 1350;
  packing.threads = 1;
  const specimens::Specimen specimen = specimens::make_specimen(packing);
  dem::Random random(9);
  std::vector<std::int32_t> place(specimen.elements());  // element i becomes place[i]
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t k = place.size() - 1; k > 0; --k) std::swap(place[k], place[random.below(k + 1)]);
  specimens::Specimen shuffled = specimen;
  for (std::size_t i = 0; i < place.size(); ++i) {
    shuffled.centres[static_cast<std::size_t>(place[i])] = specimen.centres[i];
    shuffled.radii[static_cast<std::size_t>(place[i])] = specimen.radii[i];
  }
  for (std::size_t k = 0; k < specimen.links.size(); ++k) {
    const dem::LinkGeometry& link = specimen.links[k];
    dem::LinkGeometry& to = shuffled.links[k];
    to = {place[static_cast<std::size_t>(link.a)], place[static_cast<std::size_t>(link.b)],
          link.initial_distance};
    if (random.below(2) == 0) std::swap(to.a, to.b);  // which end is a does not matter either
  }
  for (std::size_t k = shuffled.links.size() - 1; k > 0; --k)
    std::swap(shuffled.links[k], shuffled.links[random.below(k + 1)]);

  virtual_tests::UniaxialOptions options;
  options.axis = 0;
  options.max_strain = 1.2e-4;  // about the peak
  const dem::MaterialCard card;
  const auto one = virtual_tests::run_uniaxial(specimen, card, options);
  const auto two = virtual_tests::run_uniaxial(shuffled, card, options);
  ASSERT_EQ(one.steps, two.steps);
  ASSERT_EQ(one.curve.size(), two.curve.size());
  std::size_t compared = 0;
  for (std::size_t k = 0; k < one.curve.size() && one.curve[k].broken == 0; ++k, ++compared) {
    EXPECT_NEAR(two.curve[k].stress, one.curve[k].stress, 1e-6 * one.peak_stress) << k;
    EXPECT_NEAR(two.curve[k].strain_axial, one.curve[k].strain_axial, 1e-6 * one.peak_strain) << k;
    EXPECT_NEAR(two.curve[k].strain_lateral, one.curve[k].strain_lateral, 1e-6 * one.peak_strain) << k;
  }
  EXPECT_GT(compared, 20u);
  EXPECT_GT(one.curve[compared - 1].stress, 0.3 * one.peak_stress);
  EXPECT_NE(one.state_sha256, two.state_sha256);
}

TEST(Frame, RotatedAssemblyFeelsRotatedForcesWithLinksDamagedAndSheared) {
  Scene straight = shattering(8);
  straight.steps(1500);
  const dem::LinkLaw& law = straight.assembly.law;
  ASSERT_GT(dem::broken_links(law, straight.assembly.links), 20u);
  ASSERT_GT(dem::softening_links(law, straight.assembly.links), 20u);
  dem::Assembly copy = straight.assembly;
  const Mat3 turn = some_rotation();
  rotate(copy, turn);
  Scene turned(std::move(copy), straight.options.time_step);
  straight.step(), turned.step();
  double largest = 0, largest_moment = 0;
  for (std::size_t i = 0; i < straight.particles().count; ++i) {
    largest = std::max(largest, straight.force(i).norm());
    largest_moment = std::max(largest_moment, straight.moment(i).norm());
  }
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < straight.particles().count; ++i) {
    EXPECT_LT((turned.force(i) - turn * straight.force(i)).norm(), 1e-9 * largest);
    EXPECT_LT((turned.moment(i) - turn * straight.moment(i)).norm(), 1e-9 * largest_moment);
  }
  // And it goes on like that: the same motion, seen from elsewhere.
  straight.steps(50), turned.steps(50);
  for (std::size_t i = 0; i < straight.particles().count; ++i)
    EXPECT_LT((turned.position(i) - turn * straight.position(i)).norm(), 1e-11);
}

TEST(RigidMotion, TranslationLeavesNoShearAndNoForceBeyondTheRoundingOfPositions) {
  dem::Assembly made = scene::cluster(120, scene::plain_law(), 10);
  Scene scene(std::move(made), 1e-6);
  for (std::size_t i = 0; i < scene.particles().count; ++i) scene.hold(i, Vec3(300, -200, 100));
  scene.steps(1000);
  double stiffest = 0;
  for (const dem::LinkSpring& s : scene::network_of(scene.assembly).springs)
    stiffest = std::max(stiffest, s.normal_stiffness);
  const dem::Links& links = scene.assembly.links;
  for (std::size_t k = 0; k < links.count; ++k)
    ASSERT_TRUE(links.shear_x[k] == 0 && links.shear_y[k] == 0 && links.shear_z[k] == 0);
  // 1,000 additions to positions of up to half a metre, each rounded by 2^-54 or less, 40 links an element.
  for (std::size_t i = 0; i < scene.particles().count; ++i)
    EXPECT_LT(scene.force(i).norm(), 40 * stiffest * 1000 * 0x1p-54);
}

TEST(RigidMotion, QuarterTurnLeavesOnlyTheSlipOfFiniteSteps) {
  // In a step of angle d the chord is shorter than the arc by d^3/24, and the mid-step normal, scaled to m.n =
  // 1, longer than one by d^2/8: a slip of d^3/6 times the distance is left, in links across the axis. A turn
  // by A leaves A d^2/6: 1e-5 for the 250 steps here, and it falls with the square of the step.
  for (const int count : {250, 1000}) {
    dem::Assembly made = scene::cluster(120, scene::elastic_law(), 10);
    Scene scene(std::move(made), 1e-6);
    const double angle = std::numbers::pi / 2, slip = angle * std::pow(angle / count, 2) / 6;
    turn_rigidly(scene, Vec3(1, 2, -1).normalized(), angle, count);
    const dem::Links& links = scene.assembly.links;
    double worst = 0;
    for (std::size_t k = 0; k < links.count; ++k) {
      const double ks_distance =
          scene.assembly.law.shear_ratio * scene.assembly.law.normal_modulus * links.area[k];
      const double shear = Vec3(links.shear_x[k], links.shear_y[k], links.shear_z[k]).norm();
      worst = std::max(worst, shear / (ks_distance * slip));
      const Vec3 apart = scene.position(static_cast<std::size_t>(links.b[k])) -
                         scene.position(static_cast<std::size_t>(links.a[k]));
      EXPECT_NEAR(apart.norm() * links.inverse_initial_distance[k], 1, 1e-11);
    }
    EXPECT_LT(worst, 1.01) << count;
    EXPECT_GT(worst, 0.5) << "the bound names the cause, it is not slack";
  }
}

TEST(RigidMotion, CarriesAShearedLinksForceAlong) {
  const int count = 1000;
  const double angle = std::numbers::pi / 2, each = angle / count;
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(1, 2, -1).normalized()}) {
    scene::Pair pair(scene::plain_law());
    pair.stretch_to(-1e-4);
    pair.move(Vec3(0, 2.4e-5, 1.8e-5));
    const Vec3 before = pair.shear();
    ASSERT_GT(before.norm(), 1e4);
    turn_rigidly(pair, axis, angle, count);
    const Vec3 expected = Eigen::AngleAxisd(angle, axis) * before;
    // The slip of finite steps, see above; and the turn about the link's own normal is explicit, which
    // lengthens the force by half the square of each step's angle.
    const double bound =
        pair.ks() * scene::Pair::distance * angle * each * each / 6 + 0.5 * angle * each * before.norm();
    EXPECT_LT((pair.shear() - expected).norm(), 1.05 * bound) << axis.transpose();
    EXPECT_LT(bound, 4e-3 * before.norm());
  }
}
