// What a calibration leaves: the keys of its result.json and its curves as a table. Together they hold all that
// its page shows.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/pipeline.h"

namespace app {

nlohmann::ordered_json result_of(const calibrate::CalibrationCase& wanted,
                                 const calibrate::CalibrationResult& found);

/// One row a point: test, curve, kind (fitted, unseen, band low, band high, laboratory, code), strain[-],
/// stress[Pa].
std::string curves_csv(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found);

}  // namespace app
