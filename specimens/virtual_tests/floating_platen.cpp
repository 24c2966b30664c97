#include "specimens/virtual_tests/floating_platen.h"

#include <algorithm>
#include <cmath>

namespace virtual_tests {

void move_floating(dem::Particles& particles, std::span<const std::int32_t> elements, int axis, double applied,
                   double time_step, double damping, double slow) {
  double mass = 0, force = applied;
  for (const std::int32_t number : elements) {
    const auto i = static_cast<std::size_t>(number);
    mass += particles.element_mass(i);
    force += particles.force[i].value[axis];
  }
  const auto first = static_cast<std::size_t>(elements.front());
  double velocity = particles.kinematics[first].rate(axis);
  const double drag = damping * std::abs(force) * std::clamp(velocity / slow, -1.0, 1.0);
  velocity += time_step * (force - drag) / mass;
  for (const std::int32_t number : elements)
    particles.kinematics[static_cast<std::size_t>(number)].rate(axis) = velocity;
}

}  // namespace virtual_tests
