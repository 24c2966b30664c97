#include "impact/fe/state.h"

namespace fe {

State::State(const Body& body)
    : displacement(body.nodes(), Vec3::Zero()),
      velocity(body.nodes(), Vec3::Zero()),
      force(body.nodes(), Vec3::Zero()),
      mass(body.node_mass),
      inverse_mass(body.nodes(), Vec3::Zero()) {
  for (std::size_t i = 0; i < nodes(); ++i)
    if (mass[i] > 0) inverse_mass[i].setConstant(1 / mass[i]);
}

void State::lock(std::span<const std::int32_t> nodes, int axis, double value) {
  for (const std::int32_t node : nodes) {
    inverse_mass[static_cast<std::size_t>(node)][axis] = 0;
    velocity[static_cast<std::size_t>(node)][axis] = value;
  }
}

double kinetic_energy(const State& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.nodes(); ++i) sum += state.mass[i] * state.velocity[i].squaredNorm();
  return 0.5 * sum;
}

double elastic_energy(const State& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.nodes(); ++i) sum -= state.displacement[i].dot(state.force[i]);
  return 0.5 * sum;
}

Vec3 momentum(const State& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < state.nodes(); ++i) sum += state.mass[i] * state.velocity[i];
  return sum;
}

}  // namespace fe
