// What the rows of a study show together: intervals, effects beyond the scatter, Eq. 1 fitted, Sobol indices.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/rows.h"

namespace study {

/// The `statistics` of result.json. Only what the rows can answer is there:
///   quantities{} by name: mean_interval, std_interval (one setting); groups[], effect_of_groups, rank_test,
///     welch, against_reference (one setting, several [[specimen]]); factors[] (main effects of size, element
///     size, card and listed parameters); effect_of_*.words say it in a sentence
///   card_errors[]: E and nu of the elastic tests against their card, mean and largest, by card
///   eq1: alpha, beta, gamma fitted to the elastic rows of several Ks/Kn, with the points (Fig. 4)
///   sensitivity: Sobol indices of every quantity (design = "sobol", sensitivity = true)
/// The same rows give the same bits.
nlohmann::ordered_json statistics_json(const Plan& plan, const RowTable& table);

}  // namespace study
