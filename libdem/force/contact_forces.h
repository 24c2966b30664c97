// The forces of contacts: pairs that come and go, in a flat list. Links have a layout of their own,
// link_blocks.h.
#pragma once
#include <vector>

#include "libdem/force/contact_loop.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Contacts whose contributions to the ledger are summed together before the blocks are summed in order. Fixed,
/// so that sums do not depend on the number of threads.
inline constexpr std::size_t contacts_per_block = 1024;

/// Room for what contacts do to their elements.
struct ContactRows {
  Column<ContactRow> rows;
  Column<SixRow> moments;  ///< empty if the law transfers none
  std::vector<double> block_sliding;
};

/// Evaluates the law for every pair of `contacts` as it stands once the elements have moved by the coming step:
/// updates its history, fills `rows`, returns what sliding dissipated [J].
double evaluate_contacts(const LinkLaw& law, const Particles& particles, Links& contacts, double time_step,
                         ContactRows& rows, int threads);

}  // namespace dem
