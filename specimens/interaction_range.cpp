#include "specimens/interaction_range.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libdem/core/error.h"
#include "libdem/search/cell_grid.h"

namespace specimens {
namespace {

struct Candidate {
  std::int32_t a, b;
  double distance;
  double ratio;  // distance / (Ra + Rb)
};

std::vector<Candidate> candidates_up_to(double ratio, const Specimen& specimen, int threads) {
  const double largest = *std::max_element(specimen.radii.begin(), specimen.radii.end());
  const double reach = 2 * largest * ratio;
  const dem::CellGrid grid(specimen.centres, reach / 2);  // half the reach: fewer pairs that are too far apart
  constexpr std::size_t cells_per_part = 256;
  std::vector<std::vector<Candidate>> parts((grid.cells() + cells_per_part - 1) / cells_per_part);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::ptrdiff_t part = 0; part < static_cast<std::ptrdiff_t>(parts.size()); ++part) {
    auto& mine = parts[static_cast<std::size_t>(part)];
    const std::size_t first = static_cast<std::size_t>(part) * cells_per_part;
    grid.for_each_pair_within(reach, first, first + cells_per_part, [&](std::int32_t a, std::int32_t b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double distance = (specimen.centres[i] - specimen.centres[j]).norm();
      const double found = distance / (specimen.radii[i] + specimen.radii[j]);
      if (found <= ratio) mine.push_back({a, b, distance, found});
    });
  }
  std::vector<Candidate> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::vector<unsigned char> internal_elements(const Specimen& specimen) {
  const double least = internal_depth * specimen.element_size();
  std::vector<unsigned char> internal(specimen.elements());
  for (std::size_t k = 0; k < internal.size(); ++k) internal[k] = specimen.depth(specimen.centres[k]) > least;
  return internal;
}

double mean_interior_coordination(const Specimen& specimen) {
  const auto internal = internal_elements(specimen);
  const auto count = std::accumulate(internal.begin(), internal.end(), std::size_t{0});
  std::size_t ends = 0;
  for (const Link& link : specimen.links)
    ends +=
        std::size_t{internal[static_cast<std::size_t>(link.a)]} + internal[static_cast<std::size_t>(link.b)];
  return count == 0 ? 0 : static_cast<double>(ends) / static_cast<double>(count);
}

void link(Specimen& specimen, int threads) {
  if (threads <= 0) threads = omp_get_max_threads();
  const auto internal = internal_elements(specimen);
  const auto count = std::accumulate(internal.begin(), internal.end(), std::size_t{0});
  if (count == 0)
    throw dem::InputError("specimen", "no element is deeper than two element sizes", "take more elements");
  const double wanted = wanted_coordination * static_cast<double>(count);  // ends of links in internal elements

  for (double ratio = 1.65; ratio < 10; ratio *= 1.3) {
    std::vector<Candidate> pairs = candidates_up_to(ratio, specimen, threads);
    std::sort(pairs.begin(), pairs.end(), [](const Candidate& p, const Candidate& q) {
      return p.ratio != q.ratio ? p.ratio < q.ratio : p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    double ends = 0, best_miss = wanted;
    std::size_t best = 0;  // how many pairs to link
    for (std::size_t k = 0; k < pairs.size() && ends < wanted; ++k) {
      ends += internal[static_cast<std::size_t>(pairs[k].a)] + internal[static_cast<std::size_t>(pairs[k].b)];
      const bool tied = k + 1 < pairs.size() && pairs[k + 1].ratio == pairs[k].ratio;
      if (!tied && std::abs(ends - wanted) < best_miss) {
        best_miss = std::abs(ends - wanted);
        best = k + 1;
      }
    }
    if (ends < wanted || best == pairs.size()) continue;  // look farther
    specimen.interaction_radius_factor = 0.5 * (pairs[best - 1].ratio + pairs[best].ratio);
    pairs.resize(best);
    std::sort(pairs.begin(), pairs.end(),
              [](const Candidate& p, const Candidate& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    specimen.links.clear();
    specimen.links.reserve(best);
    for (const Candidate& pair : pairs) specimen.links.push_back({pair.a, pair.b, pair.distance});
    return;
  }
  throw dem::InputError("specimen",
                        fmt::format("its {} elements are too far apart for 12 links each", specimen.elements()),
                        "pack it denser, or take more elements");
}

}  // namespace specimens
