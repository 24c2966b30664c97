// What a calibration leaves: the keys of its result.json and its curves as a table.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/pipeline.h"

namespace app {

nlohmann::ordered_json result_of(const calibrate::CalibrationCase& wanted,
                                 const calibrate::CalibrationResult& found);

/// One row a point: test, curve, kind (fitted, unseen, laboratory, code), strain[-], stress[Pa].
std::string curves_csv(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found);

}  // namespace app
