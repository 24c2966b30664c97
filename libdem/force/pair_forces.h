// From state and law to the pairs' forces: the only loop over pairs in a step.
#pragma once
#include <vector>

#include "libdem/force/pair_loop.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Pairs whose contributions to the ledger are summed together before the blocks are summed in order. Fixed, so
/// that sums do not depend on the number of threads.
inline constexpr std::size_t pairs_per_block = 1024;

/// Room for what the pairs of one set do to their elements.
struct PairRows {
  Column<PairRow> rows;
  std::vector<double> block_sliding;
};

/// Evaluates the law for every pair of `links`: updates its history, fills `rows`, returns what sliding
/// dissipated [J].
double evaluate_pairs(const LinkLaw& law, const Particles& particles, Links& links, double time_step,
                      PairRows& rows, int threads);

}  // namespace dem
