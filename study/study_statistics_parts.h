// The parts of statistics_json. Only the study_*statistics.cpp files include it.
#pragma once
#include <nlohmann/json.hpp>

#include "study/rows.h"
#include "study/statistics/bootstrap.h"

namespace study {

using Json = nlohmann::ordered_json;

/// [low, high], null where there is none.
Json to_json(const statistics::Interval& interval);
/// null if it is not finite.
Json number_or_null(double value);

/// What one quantity's rows say of groups and factors (study_effects_statistics.cpp). `one_setting`: there is
/// one card and nothing varies.
Json effects_json(const Plan& plan, const Sample& sample, bool one_setting);
/// Empty object if the study has no elastic test (study_elastic_statistics.cpp).
Json card_errors_json(const Plan& plan, const RowTable& table);
Json eq1_json(const Plan& plan, const RowTable& table);

}  // namespace study
