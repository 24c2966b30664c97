#include "study/task_result.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "libdem/core/error.h"
#include "study/plan_key.h"

namespace study {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* format = "spall-study-result";

Value value_from(const Json& json, const std::string& file, const std::string& name) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  // JSON knows no NaN: it is written as null.
  if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
  throw dem::InputError(file, fmt::format("{} is neither number nor text", name),
                        "delete the file and run again");
}

}  // namespace

double number_of(const std::vector<std::pair<std::string, Value>>& values, const std::string& name) {
  for (const auto& [key, value] : values) {
    if (key != name) continue;
    if (const double* real = std::get_if<double>(&value)) return *real;
    if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Json to_json(const Value& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

Json to_json(const TaskResult& result) {
  Json json{{"format", format}, {"version", result_version}, {"key", result.key}};
  for (const auto& [name, value] : result.values) json["result"][name] = to_json(value);
  const virtual_tests::CurveTable& curve = result.curve;
  if (!curve.empty())
    for (const virtual_tests::CurveColumn& column : curve.columns) {
      json["curve"][column.name] = curve.column(column.name);
      json["curve_units"][column.name] = column.unit;
    }
  return json;
}

TaskResult result_from(const Json& json, const std::string& file) {
  if (json.value("format", "") != format || json.value("version", 0) != result_version)
    throw dem::InputError(file, "is no result of a task, or one of another version", "delete it and run again");
  TaskResult result;
  result.key = json.at("key").get<std::string>();
  for (const auto& [name, value] : json.at("result").items())
    result.values.emplace_back(name, value_from(value, file, name));
  if (json.contains("curve")) {
    const Json& curve = json.at("curve");
    std::vector<std::vector<double>> columns;
    for (const auto& [name, list] : curve.items()) {
      result.curve.columns.push_back({name, json.at("curve_units").at(name).get<std::string>()});
      std::vector<double>& column = columns.emplace_back();
      for (const Json& number : list)
        column.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN() : number.get<double>());
      if (column.size() != columns.front().size())
        throw dem::InputError(file, fmt::format("the curve's column {} has another length", name),
                              "delete the file and run again");
    }
    for (std::size_t row = 0; !columns.empty() && row < columns.front().size(); ++row)
      for (const std::vector<double>& column : columns) result.curve.values.push_back(column[row]);
  }
  return result;
}

Json to_json(const TaskTime& time) {
  return {
      {"wall_seconds", time.wall_seconds}, {"step_loop_seconds", time.step_loop_seconds}, {"host", time.host}};
}

TaskTime time_from(const Json& json) {
  return {json.at("wall_seconds").get<double>(), json.at("step_loop_seconds").get<double>(),
          json.at("host").get<std::string>()};
}

}  // namespace study
