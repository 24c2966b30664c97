// What the interface of coupling_bar.h reflects: pulses that run along it, against the same bar without an
// interface.
#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "tests/scenes/coupling_bar.h"

namespace coupling_scene {

/// Wide enough that the pack's own unevenness averages out across a plane wave.
inline const Bar& wide_bar() {
  static const Bar made(2.0, 0.1, 1.025);
  return made;
}

/// A pulse's length in finite elements, and the part of its energy that an interface may send back.
struct PulseGoal {
  double lengths, reflected;
};
inline constexpr std::array<PulseGoal, 4> pulse_goals = {{{20, 0.001}, {10, 0.002}, {5, 0.01}, {2, 0.03}}};

/// Energy of the difference between the coupled discrete elements below the overlap and the same ones of the
/// whole bar.
inline double difference_below(const Bar& bar, const BarRun& run, const BarRun& plain, double inner) {
  std::vector<double> u(plain.discrete.u), v(plain.discrete.v);
  std::size_t next = 0;  // both keep the order of the pack
  for (std::size_t i = 0; i < plain.discrete.centres.size(); ++i) {
    if (plain.discrete.centres[i].x() >= bar.outer) continue;
    for (std::size_t c = 0; c < 6; ++c)
      u[6 * i + c] -= run.discrete.u[6 * next + c], v[6 * i + c] -= run.discrete.v[6 * next + c];
    ++next;
  }
  return energy(plain.discrete, u, v, v, inner);
}

/// The same of the finite elements beyond the overlap.
inline double difference_beyond(const Bar& bar, const BarRun& run, const BarRun& plain) {
  const std::size_t skip = plain.mesh.nodes.size() - run.mesh.nodes.size();
  double sum = 0;
  std::vector<Vec3> u(plain.mesh.nodes.size(), Vec3::Zero());
  for (std::size_t i = 0; i < run.mesh.nodes.size(); ++i) {
    if (run.mesh.nodes[i].x() < bar.outer - 1e-9) continue;
    u[skip + i] = run.nodes->displacement[i] - plain.nodes->displacement[skip + i];
    const Vec3 v = run.nodes->velocity[i] - plain.nodes->velocity[skip + i];
    sum += 0.5 * plain.nodes->mass[skip + i] * v.squaredNorm();
  }
  for (std::size_t e = 0; e < plain.body->elements(); ++e) {
    if (plain.mesh.corners(e).col(0).minCoeff() < bar.outer - 1e-9) continue;
    Eigen::Matrix<double, 24, 1> local;
    for (int a = 0; a < 8; ++a)
      local.segment<3>(3 * a) =
          u[static_cast<std::size_t>(plain.body->connectivity[e][static_cast<std::size_t>(a)])];
    sum += 0.5 * local.dot(plain.body->element_stiffness(e) * local);
  }
  return sum;
}

/// Energy that the interface sends back over the energy of the pulse: that of the difference to the bar without
/// an interface, in the domain that the pulse came from, once it has passed. `lengths` in finite elements.
inline double reflected(const Bar& bar, From from, int axis, double lengths, const BarOptions& options = {}) {
  const double duration = lengths * element / bar.speed(axis);
  BarRun run = coupled_run(bar, options), plain;
  if (from == From::discrete)
    plain.discrete = bar.whole;
  else
    add_finite(plain, bar, 0, nullptr);
  plain.time_step = bar.time_step;
  for (BarRun* one : {&run, &plain}) {
    one->axis = axis;
    push(*one, bar, from);
  }
  const auto steps = static_cast<int>((1.45 + lengths * element * 0.9) / bar.speed(axis) / run.time_step);
  for (int n = 0; n < steps; ++n) {
    const double force = hump(n * run.time_step, duration);
    run.step(force), plain.step(force);
  }
  if (from == From::discrete)
    return difference_below(bar, run, plain, bar.outer - options.layers * element) /
           energy(plain.discrete, plain.discrete.u, plain.discrete.v, plain.discrete.v);
  fe::internal_force(*plain.body, *plain.nodes, plain.room);
  return difference_beyond(bar, run, plain) /
         (fe::kinetic_energy(*plain.nodes) + fe::elastic_energy(*plain.nodes));
}

}  // namespace coupling_scene
