// A run that has gone wrong is stopped at once, and says which element, when and why.
#include "libdem/run/watch.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "libdem/core/error.h"
#include "libdem/motion/critical_step.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"

using testing::AllOf;
using testing::HasSubstr;

namespace {

const specimens::Specimen& prism() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.size = {0.2, 0.1, 0.1};
    packing.elements = 1100;
    return specimens::make_specimen(packing);
  }();
  return made;
}

/// Steps until the watch stops the run; its words, and the step in `step`. Empty if it does not within `most`.
std::string stopped_with(dem::Assembly& assembly, double time_step, long& step, long most) {
  dem::StepRoom room(assembly);
  dem::StepOptions options;
  options.time_step = time_step;
  room.max_speed = 1;
  for (step = 1; step <= most; ++step) {
    const dem::StepSums sums = dem::advance(assembly, room, options);
    try {
      dem::watch_motion(assembly, room, sums, time_step, step, "test");
    } catch (const dem::RunError& error) {
      return error.what();
    }
  }
  return "";
}

double critical(dem::Assembly& assembly) {
  return dem::critical_time_step(virtual_tests::link_network(prism(), assembly), assembly.particles);
}

}  // namespace

TEST(Watch, ARunThatIsWellIsLeftAlone) {
  dem::Assembly assembly = virtual_tests::make_assembly(prism(), dem::MaterialCard{});
  assembly.particles.set_velocity(7, {1, 2, 3});
  long step = 0;
  EXPECT_EQ(stopped_with(assembly, 0.7 * critical(assembly), step, 2000), "");
}

TEST(Watch, WhatIsNoNumberIsFoundInTheStepThatMakesItWithItsElement) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    dem::Assembly assembly = virtual_tests::make_assembly(prism(), dem::MaterialCard{});
    assembly.particles.inertia[321].inverse_mass = bad;
    assembly.particles.kinematics[321].vx = 1e-3;
    long step = 0;
    const std::string words = stopped_with(assembly, 0.7 * critical(assembly), step, 100);
    EXPECT_LE(step, 3);
    EXPECT_THAT(words, AllOf(HasSubstr("test diverged at step"), HasSubstr("element "),
                             HasSubstr("lower the time step")));
    if (step == 1) {
      EXPECT_THAT(words, HasSubstr("element 321,"));
    }
  }
}

TEST(Watch, AStepBeyondTheCriticalOneIsStoppedBeforeNumbersOverflow) {
  dem::MaterialCard unbreakable;
  unbreakable.tensile_strength = unbreakable.cohesion = 1e15;
  dem::Assembly assembly = virtual_tests::make_assembly(prism(), unbreakable);
  assembly.particles.set_velocity(7, {1e-3, 0, 0});
  long step = 0;
  const std::string words = stopped_with(assembly, 1.3 * critical(assembly), step, 100000);
  EXPECT_THAT(words, HasSubstr("m in one step, more than its radius"));
  for (std::size_t i = 0; i < assembly.particles.count; ++i)
    EXPECT_TRUE(assembly.particles.kinematics[i].position().allFinite());
}

TEST(Watch, AContactThatFormedSinceIsNamedAsTheLikelyCause) {
  dem::Assembly assembly = virtual_tests::make_assembly(prism(), dem::MaterialCard{});
  const dem::StepRoom room(assembly);
  assembly.contacts =
      dem::make_links(std::vector<dem::LinkGeometry>{{40, 800, 0.02}}, assembly.particles.radius);
  assembly.particles.kinematics[40].vx = std::nan("");
  try {
    dem::watch_motion(assembly, room, {0, 0, std::nan("")}, 1e-6, 12, "test");
    FAIL() << "nothing was said";
  } catch (const dem::RunError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("diverged at step 12: element 40,"), HasSubstr("contact with element 800")));
  }
}

TEST(Watch, EnergyThatComesFromNowhereStopsARun) {
  dem::EnergyLedger ledger;
  ledger.external = 10, ledger.elastic = 9, ledger.softening = 1;
  EXPECT_NO_THROW(dem::watch_energy(ledger, 5, "test"));
  ledger.elastic = 8;  // lost: a matter for the balance error, not a danger
  EXPECT_NO_THROW(dem::watch_energy(ledger, 5, "test"));
  ledger.elastic = 14;
  EXPECT_THROW(dem::watch_energy(ledger, 5, "test"), dem::RunError);
  ledger.elastic = std::nan("");
  EXPECT_THROW(dem::watch_energy(ledger, 5, "test"), dem::RunError);
}
