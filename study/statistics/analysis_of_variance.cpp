#include "study/statistics/analysis_of_variance.h"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "study/statistics/summary.h"

namespace study::statistics {
namespace {

/// Sums of squares below this share of the values' own are rounding.
constexpr double rounding = 1e-24;

double sum_of_squares_about(const std::vector<double>& values, double centre) {
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum;
}

struct Fit {
  double residual = 0;  ///< sum of squares
  std::size_t rank = 0;
};

/// Least squares of the values on a constant and on the factors, all but number `without`. The columns of a
/// factor are its levels' indicators; what is not independent of the rest drops out by the rank.
Fit fit_without(const Eigen::VectorXd& values, const std::vector<Factor>& factors, std::size_t without) {
  const Eigen::Index rows = values.size();
  std::vector<Eigen::VectorXd> columns{Eigen::VectorXd::Ones(rows)};
  for (std::size_t f = 0; f < factors.size(); ++f) {
    if (f == without) continue;
    std::map<std::size_t, Eigen::VectorXd> indicators;
    for (Eigen::Index r = 0; r < rows; ++r) {
      auto [entry, added] = indicators.try_emplace(factors[f].levels[static_cast<std::size_t>(r)]);
      if (added) entry->second = Eigen::VectorXd::Zero(rows);
      entry->second[r] = 1;
    }
    for (auto& [level, indicator] : indicators) columns.push_back(std::move(indicator));
  }
  Eigen::MatrixXd design(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) design.col(static_cast<Eigen::Index>(k)) = columns[k];
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(design);
  const Eigen::VectorXd rest = values - design * solver.solve(values);
  return {rest.squaredNorm(), static_cast<std::size_t>(solver.rank())};
}

}  // namespace

std::optional<OneWay> one_way(const Groups& groups) {
  OneWay result;
  std::vector<double> all;
  std::size_t used = 0;
  for (const std::vector<double>& group : groups) {
    if (group.empty()) continue;
    ++used;
    all.insert(all.end(), group.begin(), group.end());
    result.sum_within += sum_of_squares_about(group, summarise(group).mean);
  }
  if (used < 2 || all.size() <= used) return std::nullopt;
  const double mean = summarise(all).mean;
  for (const std::vector<double>& group : groups)
    if (!group.empty()) {
      const double distance = summarise(group).mean - mean;
      result.sum_between += static_cast<double>(group.size()) * distance * distance;
    }
  if (!(result.sum_within > rounding * sum_of_squares_about(all, 0))) return std::nullopt;
  result.degrees_between = used - 1;
  result.degrees_within = all.size() - used;
  const auto between = static_cast<double>(result.degrees_between),
             within = static_cast<double>(result.degrees_within);
  const double scatter = result.sum_within / within, total = result.sum_between + result.sum_within;
  result.F = result.sum_between / between / scatter;
  result.p = gsl_cdf_fdist_Q(result.F, between, within);
  result.eta_squared = result.sum_between / total;
  result.omega_squared = std::max(0.0, (result.sum_between - between * scatter) / (total + scatter));
  return result;
}

std::optional<Welch> welch(const Groups& groups) {
  if (groups.size() < 2) return std::nullopt;
  const auto k = static_cast<double>(groups.size());
  std::vector<double> weight, mean;
  double total = 0, grand = 0;
  for (const std::vector<double>& group : groups) {
    if (group.size() < 2) return std::nullopt;
    const Summary summary = summarise(group);
    const double variance = summary.standard_deviation * summary.standard_deviation;
    if (!(variance > 0)) return std::nullopt;
    weight.push_back(static_cast<double>(group.size()) / variance);
    mean.push_back(summary.mean);
    total += weight.back(), grand += weight.back() * mean.back();
  }
  grand /= total;
  double between = 0, lambda = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    between += weight[g] * (mean[g] - grand) * (mean[g] - grand) / (k - 1);
    const double rest = 1 - weight[g] / total;
    lambda += rest * rest / static_cast<double>(groups[g].size() - 1);
  }
  Welch result;
  result.F = between / (1 + 2 * (k - 2) / (k * k - 1) * lambda);
  result.degrees_between = k - 1;
  result.degrees_within = (k * k - 1) / (3 * lambda);
  result.p = gsl_cdf_fdist_Q(result.F, result.degrees_between, result.degrees_within);
  return result;
}

std::optional<MainEffects> main_effects(std::span<const double> values, const std::vector<Factor>& factors) {
  for (const Factor& factor : factors)
    if (factor.levels.size() != values.size())
      throw std::invalid_argument("main_effects: " + factor.name + " has not a level for each value");
  if (values.empty()) return std::nullopt;
  const Eigen::Map<const Eigen::VectorXd> column(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::VectorXd centred = column.array() - summarise(values).mean;

  MainEffects result;
  result.total_sum = centred.squaredNorm();
  const Fit full = fit_without(centred, factors, factors.size());
  if (full.rank >= values.size()) return std::nullopt;
  result.residual_degrees = values.size() - full.rank;
  result.residual_sum = full.residual;
  if (!(result.residual_sum > rounding * column.squaredNorm())) return std::nullopt;
  const double scatter = full.residual / static_cast<double>(result.residual_degrees);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const Fit less = fit_without(centred, factors, f);
    Term term;
    term.factor = factors[f].name;
    term.degrees = full.rank - less.rank;
    term.F = term.p = std::numeric_limits<double>::quiet_NaN();
    if (term.degrees > 0) {
      const auto degrees = static_cast<double>(term.degrees);
      term.sum_of_squares = std::max(0.0, less.residual - full.residual);
      term.F = term.sum_of_squares / degrees / scatter;
      term.p = gsl_cdf_fdist_Q(term.F, degrees, static_cast<double>(result.residual_degrees));
    }
    term.eta_squared = term.sum_of_squares / result.total_sum;
    term.partial_eta_squared = term.sum_of_squares / (term.sum_of_squares + full.residual);
    result.terms.push_back(std::move(term));
  }
  return result;
}

}  // namespace study::statistics
