// A long elastic run of the coupled bar: energy, momentum, and the tie itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "tests/verification/coupling_bar.h"

namespace {

using namespace coupling_scene;

const Bar& bar() {
  static const Bar made(0.6, 0.05, 0.325);
  return made;
}

struct Energies {
  double first = 0, last = 0;  // [J], means over a quarter of the run
  double drift() const { return last / first - 1; }
};

/// A pulse that runs to and fro for `steps` steps. Energies at t_n by 1/2 m v(-).v(+), which an exact leapfrog
/// keeps.
Energies run_long(BarRun& run, int steps) {
  push(run, bar(), From::discrete);
  const double duration = 5 * element / bar().speed(0);
  Energies result;
  double window = 0;
  const int per_window = steps / 48;
  int samples = 0;
  for (int n = 0; n < steps; ++n) {
    const double time = n * run.time_step;
    const bool sampled = time > 1.01 * duration && n % 12 == 0;
    std::vector<double> before;
    std::vector<Vec3> nodes_before;
    if (sampled) before = run.discrete.v, nodes_before = run.nodes->velocity;
    run.step(hump(time, duration));
    if (!sampled) continue;
    double sum = energy(run.discrete, run.discrete.u, before, run.discrete.v);
    fe::State at_rest = *run.nodes;  // the force of this very step, whatever the interval
    fe::internal_force(*run.body, at_rest, run.room);
    sum += fe::elastic_energy(at_rest);
    for (std::size_t i = 0; i < nodes_before.size(); ++i)
      sum += 0.5 * run.nodes->mass[i] * nodes_before[i].dot(run.nodes->velocity[i]);
    window += sum;
    if (++samples % per_window != 0) continue;
    result.last = window / per_window, window = 0;
    if (result.first == 0) result.first = result.last;
  }
  return result;
}

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
    BarRun run = coupled_run(bar(), options);
    const double drift = run_long(run, 20000).drift();
    EXPECT_NEAR(drift, 0, 1e-6) << "the strict tie does no work";
    RecordProperty(ties == coupling::Ties::displacements ? "displacements" : "rotations_too",
                   std::to_string(drift));
  }
}

TEST(CoupledBar, KeepsItsEnergyWhenFiniteElementsStepFourTimesLonger) {
  BarOptions options;
  options.interval = 4;
  BarRun run = coupled_run(bar(), options);
  EXPECT_GT(4 * run.time_step, 0.8 * fe::critical_time_step(*run.body)) << "near the longest allowed";
  EXPECT_LT(run.sub_stepping->near_elements(), run.body->elements() / 2);
  const double drift = run_long(run, 20000).drift();
  EXPECT_NEAR(drift, 0, 0.002);
  RecordProperty("drift", std::to_string(drift));
}

TEST(CoupledBar, LosesEnergyWhereThatIsTheBargain) {
  BarOptions lumped;
  lumped.tie.solve = coupling::MultiplierSolve::lumped;
  BarOptions relaxed;
  relaxed.tie.relaxation_time = 2 * bar().time_step;
  for (const BarOptions& options : {lumped, relaxed}) {
    BarRun run = coupled_run(bar(), options);
    const double drift = run_long(run, 3000).drift();
    EXPECT_LT(drift, -0.02);
    EXPECT_GT(drift, -1);
    RecordProperty(options.tie.relaxation_time > 0 ? "relaxed" : "lumped", std::to_string(drift));
  }
}

TEST(CoupledBar, KeepsItsMomentum) {
  for (const int interval : {1, 3}) {
    BarOptions options;
    options.interval = interval;
    BarRun run = coupled_run(bar(), options);
    run.axis = 0;
    push(run, bar(), From::discrete);
    const double duration = 5 * element / bar().speed(0);
    double impulse = 0;
    for (int n = 0; n < 2000; ++n) {
      const double force = hump(n * run.time_step, duration);
      impulse += run.time_step * force;
      run.step(force);
    }
    EXPECT_LT((momentum(run) - Vec3(impulse, 0, 0)).norm(), 1e-9 * impulse);
  }
}
