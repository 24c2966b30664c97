// A long elastic run of the bar of coupling_bar.h: what becomes of its energy.
#pragma once
#include <vector>

#include "tests/scenes/coupling_bar.h"

namespace coupling_scene {

inline const Bar& short_bar() {
  static const Bar made(0.6, 0.05, 0.325);
  return made;
}

struct Energies {
  double first = 0, last = 0;  // [J], means over a quarter of the run
  double drift() const { return last / first - 1; }
};

/// A pulse that runs to and fro for `steps` steps. Energies at t_n by 1/2 m v(-).v(+), which an exact leapfrog
/// keeps.
inline Energies run_long(const Bar& bar, BarRun& run, int steps) {
  push(run, bar, From::discrete);
  const double duration = 5 * element / bar.speed(0);
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

}  // namespace coupling_scene
