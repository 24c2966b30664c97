#include "libdem/drive/platens.h"

#include <algorithm>

#include "libdem/core/error.h"

namespace dem {
namespace {

double sum_forces(const Particles& particles, const std::vector<std::int32_t>& layer, int axis) {
  double total = 0;
  for (const std::int32_t i : layer) total += particles.force[static_cast<std::size_t>(i)].value[axis];
  return total;
}

double mean_position(const Particles& particles, const std::vector<std::int32_t>& layer, int axis) {
  double total = 0;
  for (const std::int32_t i : layer) total += particles.initial_position[static_cast<std::size_t>(i)][axis];
  return total / static_cast<double>(layer.size());
}

}  // namespace

const std::vector<std::string>& end_condition_names() {
  static const std::vector<std::string> names{"free", "fixed", "rough"};
  return names;
}

std::string_view name_of(EndCondition ends) { return end_condition_names()[static_cast<std::size_t>(ends)]; }

EndCondition end_condition(std::string_view name) {
  for (const EndCondition ends : {EndCondition::fixed, EndCondition::rough})
    if (name_of(ends) == name) return ends;
  return EndCondition::free;
}

double Platens::low_reaction(const Particles& particles) const { return -sum_forces(particles, low, axis); }
double Platens::high_reaction(const Particles& particles) const { return sum_forces(particles, high, axis); }

Platens find_platens(const Particles& particles, int axis, double length, double thickness) {
  Platens platens{axis, {}, {}, 0};
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double x = particles.initial_position[i][axis];
    if (x < thickness) platens.low.push_back(static_cast<std::int32_t>(i));
    if (x > length - thickness) platens.high.push_back(static_cast<std::int32_t>(i));
  }
  if (platens.low.empty() || platens.high.empty())
    throw InputError("specimen", "has no elements at one of its ends", "make it with more elements");
  platens.gauge_length =
      mean_position(particles, platens.high, axis) - mean_position(particles, platens.low, axis);
  return platens;
}

void drive(Particles& particles, const Platens& platens, EndCondition ends, double speed) {
  const double start = mean_position(particles, platens.low, platens.axis);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double along = (particles.initial_position[i][platens.axis] - start) / platens.gauge_length;
    Vec3 velocity = Vec3::Zero();
    velocity[platens.axis] = speed * (0.5 - along);
    particles.set_velocity(i, velocity);
  }
  for (const auto& [layer, velocity] :
       {std::pair(&platens.low, 0.5 * speed), std::pair(&platens.high, -0.5 * speed)})
    for (const std::int32_t i : *layer)
      for (int dof = 0; dof < 3; ++dof) {
        if (dof == platens.axis)
          particles.prescribe(static_cast<std::size_t>(i), dof, velocity);
        else if (ends == EndCondition::fixed)
          particles.prescribe(static_cast<std::size_t>(i), dof, 0);
      }
}

}  // namespace dem
