// A long elastic run of the coupled bar: energy, momentum, and the tie itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "tests/scenes/coupling_energy.h"

namespace {

using namespace coupling_scene;

Vec3 momentum(const BarRun& run) {
  Vec3 sum = fe::momentum(*run.nodes);
  for (std::size_t i = 0; i < run.discrete.centres.size(); ++i)
    sum += run.discrete.mass[i][0] * Network::three(run.discrete.v, 6 * i);
  return sum;
}

}  // namespace

TEST(CoupledBar, KeepsItsEnergyOver20000Steps) {
  for (const coupling::Ties ties :
       {coupling::Ties::displacements, coupling::Ties::displacements_and_rotations}) {
    BarOptions options;
    options.ties = ties;
    BarRun run = coupled_run(short_bar(), options);
    const double drift = run_long(short_bar(), run, 20000).drift();
    EXPECT_NEAR(drift, 0, 1e-6) << "the strict tie does no work";
    RecordProperty(ties == coupling::Ties::displacements ? "displacements" : "rotations_too",
                   std::to_string(drift));
  }
}

TEST(CoupledBar, KeepsItsEnergyWhenFiniteElementsStepFourTimesLonger) {
  BarOptions options;
  options.interval = 4;
  BarRun run = coupled_run(short_bar(), options);
  EXPECT_GT(4 * run.time_step, 0.8 * fe::critical_time_step(*run.body)) << "near the longest allowed";
  EXPECT_LT(run.sub_stepping->near_elements(), run.body->elements() / 2);
  const double drift = run_long(short_bar(), run, 20000).drift();
  EXPECT_NEAR(drift, 0, 0.002);
  RecordProperty("drift", std::to_string(drift));
}

TEST(CoupledBar, LosesEnergyWhereThatIsTheBargain) {
  BarOptions lumped;
  lumped.tie.solve = coupling::MultiplierSolve::lumped;
  BarOptions relaxed;
  relaxed.tie.relaxation_time = 2 * short_bar().time_step;
  for (const BarOptions& options : {lumped, relaxed}) {
    BarRun run = coupled_run(short_bar(), options);
    const double drift = run_long(short_bar(), run, 3000).drift();
    EXPECT_LT(drift, -0.02);
    EXPECT_GT(drift, -1);
    RecordProperty(options.tie.relaxation_time > 0 ? "relaxed" : "lumped", std::to_string(drift));
  }
}

TEST(CoupledBar, KeepsItsMomentum) {
  for (const int interval : {1, 3}) {
    BarOptions options;
    options.interval = interval;
    BarRun run = coupled_run(short_bar(), options);
    run.axis = 0;
    push(run, short_bar(), From::discrete);
    const double duration = 5 * element / short_bar().speed(0);
    double impulse = 0;
    for (int n = 0; n < 2000; ++n) {
      const double force = hump(n * run.time_step, duration);
      impulse += run.time_step * force;
      run.step(force);
    }
    EXPECT_LT((momentum(run) - Vec3(impulse, 0, 0)).norm(), 1e-9 * impulse);
  }
}
