#include "libdem/force/pair_forces.h"

#include <algorithm>

#include "libdem/core/instructions.h"

namespace dem {
namespace {

const PairLoops& pair_loops() {
  static const PairLoops chosen = choose_instructions(baseline_pair_loops
#ifdef SPALL_X86
                                                      ,
                                                      avx2_pair_loops, avx512_pair_loops
#endif
  );
  return chosen;
}

}  // namespace

double evaluate_pairs(const LinkLaw& law, const Particles& particles, Links& links, double time_step,
                      PairRows& rows, int threads) {
  const std::size_t padded = links.padded(), block_count = (padded + pairs_per_block - 1) / pairs_per_block;
  rows.rows.resize(padded);
  rows.block_sliding.resize(block_count);
  const std::size_t choice =
      (law.unloading == SofteningUnloading::elastic ? 1u : 0u) +
      (law.cohesion_during_softening == CohesionDuringSoftening::proportional ? 2u : 0u) +
      (law.broken_link_contact == BrokenLinkContact::radii ? 4u : 0u);
  const PairLoop loop = pair_loops().loop[choice];
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t block = 0; block < block_count; ++block) {
    PairLoopArguments arguments{&law,
                                time_step,
                                particles.kinematics.data(),
                                links.a.data(),
                                links.b.data(),
                                links.inverse_initial_distance.data(),
                                links.area.data(),
                                links.max_strain.data(),
                                links.shear_x.data(),
                                links.shear_y.data(),
                                links.shear_z.data(),
                                rows.rows.data(),
                                block * pairs_per_block,
                                std::min(padded, (block + 1) * pairs_per_block),
                                0};
    loop(arguments);
    rows.block_sliding[block] = arguments.sliding;
  }
  double sliding = 0;
  for (const double part : rows.block_sliding) sliding += part;
  return sliding;
}

}  // namespace dem
