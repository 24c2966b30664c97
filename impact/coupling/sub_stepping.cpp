#include "impact/coupling/sub_stepping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace coupling {

int largest_interval(double time_step, double critical_time_step, double share) {
  const double allowed = share * critical_time_step;
  if (!(time_step > 0 && time_step <= allowed))
    throw dem::InputError(
        "coupling",
        fmt::format("the time step of {:.3g} s is above {:.3g} s, which the finite elements can bear",
                    time_step, allowed),
        "make their smallest element larger or the time step shorter");
  return static_cast<int>(std::min(std::floor(allowed / time_step), 1e6));
}

SubStepping::SubStepping(const fe::Body& body, const KinematicMap& map, int interval) : every(interval) {
  std::vector<bool> tied(body.nodes(), false);
  for (const std::int32_t node : map.nodes) tied[static_cast<std::size_t>(node)] = true;
  std::vector<std::int32_t> near_list, far_list;
  for (std::size_t e = 0; e < body.elements(); ++e) {
    const fe::Hexahedron& element = body.connectivity[e];
    const bool touches = std::any_of(element.begin(), element.end(),
                                     [&](std::int32_t node) { return tied[static_cast<std::size_t>(node)]; });
    (touches || every == 1 ? near_list : far_list).push_back(static_cast<std::int32_t>(e));
  }
  near = fe::Portion(body.connectivity, std::move(near_list));
  far = fe::Portion(body.connectivity, std::move(far_list));
}

void SubStepping::advance_velocities(const fe::Body& body, fe::State& state, std::int64_t step,
                                     double time_step, int threads) {
  std::fill(state.force.begin(), state.force.end(), Vec3::Zero());
  fe::add_internal_force(body, near, 1, state, room, threads);
  if (step % every == 0) fe::add_internal_force(body, far, every, state, room, threads);
  fe::advance_velocities(state, time_step, threads);
}

ImpulseEnergy SubStepping::impulse_energy(const fe::Body& body, const fe::State& state,
                                          std::span<const Vec3> velocity_before, double time_step) const {
  if (every == 1) return {};
  fe::ElementRows rows;
  const auto forces = [&](const fe::Portion& portion, const std::vector<Vec3>& displacement) {
    fe::State one = state;
    one.displacement = displacement;
    std::fill(one.force.begin(), one.force.end(), Vec3::Zero());
    fe::add_internal_force(body, portion, 1, one, rows);
    return one.force;
  };
  const std::vector<Vec3> of_far = forces(far, state.displacement), of_near = forces(near, state.displacement),
                          of_motion = forces(far, state.velocity);
  const double interval = every * time_step, square = interval * interval / 12;
  ImpulseEnergy energy;
  for (const std::int32_t node : far.nodes) {
    const auto i = static_cast<std::size_t>(node);
    const Vec3 change = state.inverse_mass[i].cwiseProduct(of_far[i]);
    energy.kinetic -= square * velocity_before[i].dot(of_motion[i]);
    energy.elastic +=
        square * change.dot(of_far[i]) - (square - 0.25 * interval * time_step) * change.dot(of_near[i]);
  }
  return energy;
}

}  // namespace coupling
