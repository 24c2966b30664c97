// Has a factor (shape, size, element size) an effect beyond the scatter of the disorder?
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace study::statistics {

/// The values of each level of one factor.
using Groups = std::vector<std::vector<double>>;

/// F = (between / degrees_between) / (within / degrees_within), p its upper tail: how often scatter alone would
/// give as much. Assumes one normal scatter in all groups.
struct OneWay {
  double F = 0, p = 0;
  std::size_t degrees_between = 0, degrees_within = 0;
  double sum_between = 0, sum_within = 0;  ///< sums of squares, unit of the values squared
  double eta_squared = 0;                  ///< sum_between / total: share of the variance, biased upwards
  double omega_squared = 0;                ///< the same without that bias; negative counts as 0
};

/// None if there are fewer than two groups with values, if no group has two, or if nothing scatters within. A
/// group of one value counts: the scatter is then the other groups'.
std::optional<OneWay> one_way(const Groups& groups);

/// Welch's F (Biometrika 38, 1951): each group has its own scatter. None if a group has fewer than two values
/// or does not scatter.
struct Welch {
  double F = 0, p = 0;
  double degrees_between = 0, degrees_within = 0;  ///< the second need not be whole
};
std::optional<Welch> welch(const Groups& groups);

/// A factor of a study: the level of each row, by number; `name` is for the reader.
struct Factor {
  std::string name;
  std::vector<std::size_t> levels;
};

struct Term {
  std::string factor;
  std::size_t degrees = 0;  ///< 0: this factor cannot be told from the others with these rows; no F then
  double sum_of_squares = 0;
  double F = 0, p = 0;  ///< NaN without degrees
  double eta_squared = 0, partial_eta_squared = 0;
};

struct MainEffects {
  std::vector<Term> terms;  ///< in the order of the factors
  std::size_t residual_degrees = 0;
  double residual_sum = 0, total_sum = 0;
};

/// Main effects of several factors at once, unbalanced: a factor's sum of squares is what the model loses
/// without it (type II; Yates 1934), so it does not depend on the order of the factors. None if no degrees are
/// left for the residual or nothing scatters. Throws std::invalid_argument if a factor has not a level a row.
std::optional<MainEffects> main_effects(std::span<const double> values, const std::vector<Factor>& factors);

}  // namespace study::statistics
