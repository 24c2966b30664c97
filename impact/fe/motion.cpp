#include "impact/fe/motion.h"

#include <algorithm>

#include "impact/fe/element_loop.h"
#include "libdem/core/instructions.h"

namespace fe {
namespace {

constexpr std::size_t elements_per_block = 128;

ElementLoop chosen_element_loop() {
  static const ElementLoop chosen = dem::choose_instructions(baseline_fe_element_loop
#ifdef SPALL_X86
                                                             ,
                                                             avx2_fe_element_loop, avx512_fe_element_loop
#endif
  );
  return chosen;
}

}  // namespace

void advance_positions(State& state, double time_step, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t i = 0; i < state.nodes(); ++i) state.displacement[i] += time_step * state.velocity[i];
}

void internal_force(const Body& body, State& state, ElementRows& room, int threads) {
  std::fill(state.force.begin(), state.force.end(), Vec3::Zero());
  add_internal_force(body, body.all, 1, state, room, threads);
}

void add_internal_force(const Body& body, const Portion& portion, double factor, State& state,
                        ElementRows& room, int threads) {
  const std::size_t count = portion.elements.size();
  room.rows.resize(std::max(room.rows.size(), 24 * count));
  const std::size_t blocks = (count + elements_per_block - 1) / elements_per_block;
  const ElementLoop loop = chosen_element_loop();
  const ElementLoopArguments arguments{portion.elements.data(),           body.stiffness.front().data(),
                                       body.element_class.data(),         body.connectivity.front().data(),
                                       state.displacement.front().data(), room.rows.data()};
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t block = 0; block < blocks; ++block)
    loop(arguments, block * elements_per_block, std::min(count, (block + 1) * elements_per_block));
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t i = 0; i < portion.nodes.size(); ++i) {
    double x = 0, y = 0, z = 0;
    for (std::int32_t p = portion.first[i]; p < portion.first[i + 1]; ++p) {
      const double* row = &room.rows[3 * static_cast<std::size_t>(portion.entry[static_cast<std::size_t>(p)])];
      x += row[0], y += row[1], z += row[2];
    }
    state.force[static_cast<std::size_t>(portion.nodes[i])] -= factor * Vec3(x, y, z);
  }
}

void advance_velocities(State& state, double duration, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t i = 0; i < state.nodes(); ++i)
    state.velocity[i] += duration * state.inverse_mass[i].cwiseProduct(state.force[i]);
}

}  // namespace fe
