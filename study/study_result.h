// result.json and rows.csv of a study.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/rows.h"

namespace study {

/// study, tasks{}, parameters[], rows[], summary{}, settings[] (a summary for each card and point, where there
/// are several), failed[]. Depends on the plan and the results alone: no times, no order of running.
nlohmann::ordered_json result_json(const Plan& plan, const RowTable& table);

/// The rows as CSV with units in the header, SI; a column for each key that any test has.
std::string rows_csv(const Plan& plan, const RowTable& table);

}  // namespace study
