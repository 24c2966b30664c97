// What a study keeps of one virtual test.
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "specimens/virtual_tests/outcome.h"

namespace study {

using virtual_tests::Value;
/// NaN if no number has that name.
double number_of(const std::vector<std::pair<std::string, Value>>& values, const std::string& name);

/// The keys of `spall test`'s result.json in their order, SI, without its times: the same bits whenever and
/// wherever the test ran.
struct TaskResult {
  std::string key;  ///< of the task
  std::vector<std::pair<std::string, Value>> values;
  virtual_tests::CurveTable curve;  ///< empty for an elastic test
};

/// How a result came about: kept apart from it.
struct TaskTime {
  double wall_seconds = 0;       ///< of the test alone
  double step_loop_seconds = 0;  ///< 0 for an elastic test
  std::string host;
};

nlohmann::ordered_json to_json(const Value& value);
nlohmann::ordered_json to_json(const TaskResult& result);
nlohmann::ordered_json to_json(const TaskTime& time);
/// Throw nlohmann::json::exception or InputError if it is none, or of another version.
TaskResult result_from(const nlohmann::ordered_json& json, const std::string& file);
TaskTime time_from(const nlohmann::ordered_json& json);

}  // namespace study
