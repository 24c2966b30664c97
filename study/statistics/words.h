// What tests say, in sentences that do not claim more than they show.
#pragma once
#include <optional>
#include <string>

#include "study/statistics/analysis_of_variance.h"

namespace study::statistics {

/// A p value below this counts as shown.
inline constexpr double significance = 0.05;

/// "negligible", "small", "medium", "large": eta^2 below 0.01, 0.06, 0.14 (Cohen 1988).
std::string effect_size_words(double eta_squared);

/// "p = 0.31", "p < 0.001".
std::string p_words(double p);

/// "Effect of shape shown: F(6, 9) = 5.31, p = 0.013, large (eta^2 = 0.78)." or "No effect of shape shown
/// beyond the scatter: ...", and that the rows are too few if there is no test.
std::string words_of(const std::string& factor, const std::optional<OneWay>& test);
std::string words_of(const Term& term, std::size_t residual_degrees);

}  // namespace study::statistics
