#include "exchange/link_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "libdem/core/error.h"
#include "libdem/search/cell_grid.h"

namespace exchange {

double interaction_factor(const specimens::Specimen& specimen) {
  const auto ratio = [&](std::int32_t a, std::int32_t b, double distance) {
    return distance /
           (specimen.radii[static_cast<std::size_t>(a)] + specimen.radii[static_cast<std::size_t>(b)]);
  };
  double longest = 0;
  for (const specimens::Link& link : specimen.links)
    longest = std::max(longest, ratio(link.a, link.b, link.initial_distance));

  // Pairs up to there are to be the links and no others; a little farther to see where the next one begins.
  const double seen = 1.05 * std::max(longest, specimen.interaction_radius_factor);
  const double reach = 2 * seen * *std::max_element(specimen.radii.begin(), specimen.radii.end());
  const dem::CellGrid grid(specimen.centres, reach / 2);
  std::size_t within = 0;
  double next = seen;
  grid.for_each_pair_within(reach, [&](std::int32_t a, std::int32_t b) {
    const double found = ratio(
        a, b,
        (specimen.centres[static_cast<std::size_t>(a)] - specimen.centres[static_cast<std::size_t>(b)]).norm());
    if (found <= longest * (1 + 1e-12))
      ++within;
    else
      next = std::min(next, found);
  });
  if (specimen.links.empty() || within != specimen.links.size())
    throw dem::InputError(
        "specimen",
        fmt::format("has {} links where {} pairs of elements are as near as the longest of them",
                    specimen.links.size(), within),
        "Yade makes links anew by distance: export a specimen without cuts, or --to lammps-bpm or csv, which "
        "list them");
  return 0.5 * (longest + next);
}

}  // namespace exchange
