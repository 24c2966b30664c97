// One element over one step (Eq. 9): position to t_n, velocity to t_(n+1/2), local damping.
#pragma once
#include "libdem/force/lane_rows.h"
#include "libdem/motion/central_difference.h"
#include "libdem/state/particles.h"

namespace dem {
inline namespace SPALL_ISA {

/// The step's constants, spread over the six degrees of freedom, and its sums so far.
struct ElementMotion {
  Eight inverse_reference, highest, lowest;  ///< of the damping's smooth clamp
  double time_step;
  Eight damped, kinetic;  ///< energies times two, a degree of freedom each
  double fastest;         ///< [m2/s2]
};

SPALL_INLINE ElementMotion element_motion(const LocalDamping& damping, double time_step) {
  const double v = damping.factor / damping.reference_velocity, w = damping.factor / damping.reference_spin;
  const Eight zero{};
  ElementMotion motion;
  motion.inverse_reference = Eight{v, v, v, w, w, w, 0, 0};
  motion.highest = zero + damping.factor;
  motion.lowest = zero - damping.factor;
  motion.time_step = time_step;
  motion.damped = motion.kinetic = zero;
  motion.fastest = 0;
  return motion;
}

/// Reads `before`, writes `after` and adds to `rotation` (three numbers); `force` is the resultant at t_n. The
/// degrees of freedom whose bits are set in `prescribed` keep their velocities.
SPALL_INLINE void advance_element(ElementMotion& motion, const Kinematics& before, Kinematics& after,
                                  double* rotation, const Inertia& inertia, unsigned prescribed, Eight force) {
  const Eight zero{};
  const Eight velocity = load_part<Eight>(&before.vx);  // six velocities and the two unused numbers
  const Eight mass = {
      inertia.mass, inertia.mass, inertia.mass, inertia.moment, inertia.moment, inertia.moment, 0, 0};
  Eight inverse = {inertia.inverse_mass,
                   inertia.inverse_mass,
                   inertia.inverse_mass,
                   inertia.inverse_moment,
                   inertia.inverse_moment,
                   inertia.inverse_moment,
                   0,
                   0};
  if (prescribed != 0) [[unlikely]]
    for (int c = 0; c < 6; ++c)
      if ((prescribed >> c & 1u) != 0) inverse[c] = 0;

  const Four moves = __builtin_shufflevector(velocity, zero, 0, 1, 2, 8);
  store_part(&after.x, load_part<Four>(&before.x) + motion.time_step * moves);
  for (int c = 0; c < 3; ++c) rotation[c] += motion.time_step * velocity[3 + c];

  // Local damping opposes the velocity in proportion to the force; a smooth clamp stands for the sign, which
  // would turn rounding errors of a velocity near zero into finite forces.
  Eight opposed = velocity * motion.inverse_reference;
  opposed = opposed > motion.highest ? motion.highest : opposed;
  opposed = opposed < motion.lowest ? motion.lowest : opposed;
  const Eight drag = (force < zero ? -force : force) * opposed;
  const Eight next = velocity + motion.time_step * inverse * (force - drag);
  store_part(&after.vx, next);
  motion.damped += (inverse > zero ? drag : zero) * (velocity + next);
  motion.kinetic += mass * velocity * next;
  const double speed = next[0] * next[0] + next[1] * next[1] + next[2] * next[2];
  motion.fastest = speed > motion.fastest ? speed : motion.fastest;
}

}  // namespace SPALL_ISA
}  // namespace dem
