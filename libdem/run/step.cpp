#include "libdem/run/step.h"

#include <algorithm>
#include <cmath>

#include "libdem/core/sha256.h"

namespace dem {

StepSums advance(Assembly& assembly, StepRoom& room, const StepOptions& options) {
  Particles& particles = assembly.particles;
  StepSums sums;

  advance_positions(particles, options.time_step, options.threads);

  if (room.detector.update(particles, assembly.contacts, room.max_speed, options.time_step))
    room.contact_incidence = Incidence(assembly.contacts, particles.count);

  sums.sliding = evaluate_pairs(assembly.law, particles, assembly.links, options.time_step, room.link_rows,
                                options.threads);
  const bool contacts = assembly.contacts.count > 0;
  if (contacts)
    sums.sliding += evaluate_pairs(assembly.law, particles, assembly.contacts, options.time_step,
                                   room.contact_rows, options.threads);

  const MotionSums motion = advance_velocities(
      particles, room.link_rows, room.link_incidence, contacts ? &room.contact_rows : nullptr,
      contacts ? &room.contact_incidence : nullptr, options.time_step, options.damping, options.threads);
  room.max_speed = std::sqrt(motion.max_speed_squared);
  sums.damped = motion.damped;
  sums.kinetic = motion.kinetic;
  return sums;
}

std::string state_sha256(const Assembly& assembly) {
  Sha256 hash;
  const Particles& p = assembly.particles;
  hash.add(p.kinematics.data(), p.count * sizeof(Kinematics)).add(p.rotation.data(), p.count * sizeof(Vec3));
  for (const Links* links : {&assembly.links, &assembly.contacts}) {
    for (const Column<std::int32_t>* column : {&links->a, &links->b})
      hash.add(column->data(), links->count * sizeof(std::int32_t));
    for (const Column<double>* column : {&links->max_strain, &links->shear_x, &links->shear_y, &links->shear_z})
      hash.add(column->data(), links->count * sizeof(double));
  }
  return hash.hex();
}

}  // namespace dem
