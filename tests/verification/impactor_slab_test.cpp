// The paper's cube against a small slab of linked elements: what the whole step keeps while links break.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "impact/impactors/impactor.h"
#include "libdem/motion/critical_step.h"
#include "libdem/probe/damage.h"
#include "libdem/probe/energy.h"
#include "libdem/run/step.h"
#include "libdem/statics/link_network.h"
#include "specimens/packing.h"

using dem::Vec3;

namespace {

const specimens::Specimen& slab() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions options;
    options.size = {0.6, 0.5, 0.28};
    options.elements = 2500;
    return specimens::make_specimen(options);
  }();
  return made;
}

/// The slab is free; the cube comes at 40 m/s, its face, edge or corner first.
struct Hit {
  dem::Assembly assembly;
  dem::StepRoom room;
  dem::StepOptions options;
  impact::Impactor cube;
  impact::ImpactorState state;
  impact::ImpactorRoom near;
  std::vector<dem::ElementLoad> loads;
  impact::ImpactorSums last;
  double dissipated = 0, kinetic = 0;

  static dem::Assembly assemble() {
    const specimens::Specimen& s = slab();
    dem::Assembly made{dem::Particles(s.centres, s.radii, 2500 * 0.6 * 0.5 * 0.28),
                       dem::make_links(s.links, s.radii),
                       {},
                       dem::make_link_law(dem::MaterialCard())};
    return made;
  }

  Hit(impact::Lead lead, double step_fraction, int threads = 1) : assembly(assemble()), room(assembly) {
    const specimens::Specimen& s = slab();
    const dem::LinkNetwork network(s.centres, s.radii, s.links, assembly.law.normal_modulus,
                                   assembly.law.shear_ratio);
    options.time_step = step_fraction * dem::critical_time_step(network, assembly.particles);
    options.threads = threads;
    cube.shape = impact::make_box({0.3, 0.3, 0.3}, "test");
    cube.body = {impact::from_density(cube.shape, 2500, "test"), {}, "test"};
    cube.law.modulus = assembly.law.normal_modulus;
    cube.law.shear_ratio = assembly.law.shear_ratio;
    cube.law.friction = 0.3;
    cube.law.damping_ratio = 0.05;
    const Vec3 down = -Vec3::UnitZ(), above(0.33, 0.22, 1);
    const Eigen::Quaterniond turn = impact::leading(lead, {0.15, 0.15, 0.15}, down);
    const double way = impact::distance_to_contact(cube.shape, {above, turn}, down, assembly.particles).value();
    state.motion = impact::start_motion(cube.body, above + way * down, turn, 40 * down, {1, 2, 3});
  }

  void step() {
    last = impact::advance_impactor(cube, state, near, assembly.particles,
                                    {options.time_step, room.max_speed, Vec3::Zero()}, loads);
    const dem::StepSums sums = dem::advance(assembly, room, options, loads);
    dissipated += sums.sliding + last.sliding + last.damped;
    kinetic = sums.kinetic + last.kinetic;
  }
  double energy() {
    dem::settle(assembly, room);
    const auto links = dem::pair_energy(assembly.law, assembly.particles, assembly.links);
    const auto contacts = dem::pair_energy(assembly.law, assembly.particles, assembly.contacts);
    return kinetic + last.stored + dissipated + links.elastic + links.softening + contacts.elastic +
           contacts.softening;
  }
  Vec3 momentum() const {
    Vec3 sum = cube.body.mass * state.motion.velocity;
    for (std::size_t i = 0; i < assembly.particles.count; ++i)
      sum += assembly.particles.element_mass(i) * assembly.particles.kinematics[i].velocity();
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum =
        cube.body.mass * state.motion.position.cross(state.motion.velocity) + state.motion.angular_momentum;
    for (std::size_t i = 0; i < assembly.particles.count; ++i) {
      const dem::Kinematics& k = assembly.particles.kinematics[i];
      sum += assembly.particles.element_mass(i) * k.position().cross(k.velocity()) +
             assembly.particles.element_inertia(i) * k.spin();
    }
    return sum;
  }
};

}  // namespace

TEST(ImpactorSlab, KeepsMomentumAndEnergyWhileLinksBreak) {
  for (const impact::Lead lead : {impact::Lead::face, impact::Lead::edge, impact::Lead::corner}) {
    Hit hit(lead, 0.35);
    const Vec3 linear = hit.momentum(), angular = hit.angular_momentum();
    const double first =
        0.5 * hit.cube.body.mass * 1600 + 0.5 * hit.state.motion.spin.dot(hit.state.motion.angular_momentum);
    std::size_t most = 0;
    for (int n = 0; n < 300; ++n) {
      hit.step();
      most = std::max(most, hit.last.touching);
    }
    EXPECT_GE(most, lead == impact::Lead::face ? 50u : 1u);
    dem::settle(hit.assembly, hit.room);
    EXPECT_GT(dem::broken_links(hit.assembly.law, hit.assembly.links), 100u);
    EXPECT_GT(hit.state.motion.velocity.z(), -39.5);
    EXPECT_LT((hit.momentum() - linear).norm(), 1e-12 * linear.norm());
    EXPECT_LT((hit.angular_momentum() - angular).norm(), 1e-12 * angular.norm());
    EXPECT_NEAR(hit.energy() / first, 1, 3e-3);
  }
}

TEST(ImpactorSlab, BitsDoNotDependOnThreads) {
  Hit one(impact::Lead::corner, 0.5, 1), three(impact::Lead::corner, 0.5, 3);
  for (int n = 0; n < 150; ++n) one.step(), three.step();
  dem::settle(one.assembly, one.room), dem::settle(three.assembly, three.room);
  EXPECT_EQ(dem::state_sha256(one.assembly), dem::state_sha256(three.assembly));
  EXPECT_EQ(impact::to_numbers(one.state), impact::to_numbers(three.state));
}
