// The loop over elements, compiled once per instruction set: forces are summed in the order of the pairs, then
// the velocities advance (Eq. 9).
#include "libdem/motion/element_loop.h"

#include "libdem/core/lanes.h"

namespace dem {
inline namespace SPALL_ISA {
namespace {

using Eight = double __attribute__((vector_size(64)));

SPALL_INLINE Eight load_eight(const double* from) {
  Eight eight;
  __builtin_memcpy(&eight, from, sizeof eight);
  return eight;
}

/// Adds the pairs of one element, in their order.
SPALL_INLINE void add_pairs(Eight& total, const PairRow* rows, const std::int32_t* entry, std::int32_t begin,
                            std::int32_t end) {
  for (std::int32_t e = begin; e < end; ++e) {
    const std::int32_t pair = entry[e] >> 1, side = entry[e] & 1;
    const double* row = rows[pair].value;
    const double sign = side == 0 ? 1 : -1, arm = row[6 + side];
    const Eight factor = {sign, sign, sign, arm, arm, arm, 0, 0};
    total += load_eight(row) * factor;
  }
}

void element_loop(ElementLoopArguments& arguments) {
  const Eight zero{};
  const double strength = arguments.damping;
  const double v = arguments.inverse_reference_velocity * strength,
               w = arguments.inverse_reference_spin * strength;
  const Eight inverse_reference = {v, v, v, w, w, w, 0, 0};
  const Eight highest = zero + strength, lowest = zero - strength;
  Eight damped{}, kinetic{};
  double fastest = 0;
  for (std::size_t i = arguments.begin; i < arguments.end; ++i) {
    Eight force{};
    add_pairs(force, arguments.link_rows, arguments.link_entry, arguments.link_first[i],
              arguments.link_first[i + 1]);
    if (arguments.contact_rows != nullptr)
      add_pairs(force, arguments.contact_rows, arguments.contact_entry, arguments.contact_first[i],
                arguments.contact_first[i + 1]);
    __builtin_memcpy(arguments.force[i].value, &force, sizeof force);

    double* velocity = &arguments.kinematics[i].vx;  // six velocities and the two unused numbers
    const Eight before = load_eight(velocity), mass = load_eight(arguments.mass[i].value);
    const Eight inverse = load_eight(arguments.inverse_mass[i].value);
    // Local damping opposes the velocity in proportion to the force; a smooth clamp stands for the sign, which
    // would turn rounding errors of a velocity near zero into finite forces.
    Eight opposed = before * inverse_reference;
    opposed = opposed > highest ? highest : opposed;
    opposed = opposed < lowest ? lowest : opposed;
    const Eight drag = (force < zero ? -force : force) * opposed;
    const Eight after = before + arguments.time_step * inverse * (force - drag);
    __builtin_memcpy(velocity, &after, sizeof after);
    const Eight free = inverse > zero ? drag : zero;
    damped += free * (before + after);
    kinetic += mass * before * after;
    const double speed = after[0] * after[0] + after[1] * after[1] + after[2] * after[2];
    fastest = speed > fastest ? speed : fastest;
  }
  double damped_sum = 0, kinetic_sum = 0;
  for (int c = 0; c < 6; ++c) damped_sum += damped[c], kinetic_sum += kinetic[c];
  arguments.damped = 0.5 * arguments.time_step * damped_sum;
  arguments.kinetic = 0.5 * kinetic_sum;
  arguments.max_speed_squared = fastest;
}

}  // namespace
}  // namespace SPALL_ISA

ElementLoop SPALL_JOIN(SPALL_ISA, _element_loop)() { return SPALL_ISA::element_loop; }

}  // namespace dem
