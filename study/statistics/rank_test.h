// The same question as an analysis of variance, asked of ranks: no normal scatter is assumed.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "study/statistics/analysis_of_variance.h"

namespace study::statistics {

/// Kruskal and Wallis (JASA 47, 1952), corrected for ties. p is the chi-square's upper tail, which wants about
/// five values a group; with fewer it is a rough one.
struct KruskalWallis {
  double H = 0, p = 0;
  std::size_t degrees = 0;
};

/// None if fewer than two groups have values, or all values are equal.
std::optional<KruskalWallis> kruskal_wallis(const Groups& groups);

}  // namespace study::statistics
