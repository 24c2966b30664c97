#include "study/statistics/rank_test.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <utility>

namespace study::statistics {

std::optional<KruskalWallis> kruskal_wallis(const Groups& groups) {
  std::vector<std::pair<double, std::size_t>> values;  // value, group
  std::size_t used = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const double value : groups[g]) values.emplace_back(value, g);
    if (!groups[g].empty()) ++used;
  }
  if (used < 2) return std::nullopt;
  std::ranges::sort(values);
  std::vector<double> rank_sum(groups.size(), 0.0);
  double ties = 0;
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin;
    while (end < values.size() && values[end].first == values[begin].first) ++end;
    const auto equal = static_cast<double>(end - begin);
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);  // mean of begin + 1 to end
    for (std::size_t k = begin; k < end; ++k) rank_sum[values[k].second] += rank;
    ties += equal * equal * equal - equal;
    begin = end;
  }
  const auto n = static_cast<double>(values.size());
  const double correction = 1 - ties / (n * n * n - n);
  if (!(correction > 0)) return std::nullopt;
  double sum = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (!groups[g].empty()) sum += rank_sum[g] * rank_sum[g] / static_cast<double>(groups[g].size());
  KruskalWallis result;
  result.H = (12 / (n * (n + 1)) * sum - 3 * (n + 1)) / correction;
  result.degrees = used - 1;
  result.p = gsl_cdf_chisq_Q(result.H, static_cast<double>(result.degrees));
  return result;
}

}  // namespace study::statistics
