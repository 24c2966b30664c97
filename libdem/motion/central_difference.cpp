#include "libdem/motion/central_difference.h"

#include <algorithm>

#include "libdem/core/instructions.h"
#include "libdem/motion/element_loop.h"

namespace dem {
namespace {

ElementLoop chosen_element_loop() {
  static const ElementLoop chosen = choose_instructions(baseline_element_loop
#ifdef SPALL_X86
                                                        ,
                                                        avx2_element_loop, avx512_element_loop
#endif
  );
  return chosen;
}

}  // namespace

MotionSums advance_velocities(Particles& particles, const PairRows& link_rows, const Incidence& link_incidence,
                              const PairRows* contact_rows, const Incidence* contact_incidence,
                              double time_step, const LocalDamping& damping, int threads) {
  const std::size_t block_count = (particles.count + elements_per_block - 1) / elements_per_block;
  std::vector<MotionSums> sums(block_count);
  const bool contacts =
      contact_rows != nullptr && contact_incidence != nullptr && !contact_incidence->entry.empty();
  const ElementLoop loop = chosen_element_loop();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t block = 0; block < block_count; ++block) {
    ElementLoopArguments arguments{particles.kinematics.data(),
                                   particles.mass.data(),
                                   particles.inverse_mass.data(),
                                   particles.force.data(),
                                   link_rows.rows.data(),
                                   link_incidence.first.data(),
                                   link_incidence.entry.data(),
                                   contacts ? contact_rows->rows.data() : nullptr,
                                   contacts ? contact_incidence->first.data() : nullptr,
                                   contacts ? contact_incidence->entry.data() : nullptr,
                                   time_step,
                                   damping.factor,
                                   1 / damping.reference_velocity,
                                   1 / damping.reference_spin,
                                   block * elements_per_block,
                                   std::min(particles.count, (block + 1) * elements_per_block),
                                   0,
                                   0,
                                   0};
    loop(arguments);
    sums[block] = {arguments.damped, arguments.kinetic, arguments.max_speed_squared};
  }
  MotionSums total;
  for (const MotionSums& part : sums) {
    total.damped += part.damped;
    total.kinetic += part.kinetic;
    total.max_speed_squared = std::max(total.max_speed_squared, part.max_speed_squared);
  }
  return total;
}

void advance_positions(Particles& particles, double time_step, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t i = 0; i < particles.count; ++i) {
    Kinematics& k = particles.kinematics[i];
    k.x += time_step * k.vx;
    k.y += time_step * k.vy;
    k.z += time_step * k.vz;
    particles.rotation[i] += time_step * k.spin();
  }
}

}  // namespace dem
