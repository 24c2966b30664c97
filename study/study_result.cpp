#include "study/study_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/statistics/summary.h"
#include "study/study_statistics.h"

namespace study {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const RowTable& table, const Row& row) {
  Json json;
  json["task"] = row.task;
  json["specimen"] = row.specimen;
  json["shape"] = row.shape;
  json["seed"] = row.seed;
  json["size"] = {row.size.x(), row.size.y(), row.size.z()};
  json["elements"] = row.elements;
  json["element_size"] = row.element_size;
  json["card"] = row.card;
  if (!table.parameters.empty()) {
    json["point"] = row.point;
    if (!row.block.empty()) json["block"] = row.block, json["base"] = row.base;
    for (std::size_t p = 0; p < table.parameters.size(); ++p)
      json["parameters"][table.parameters[p]] = row.parameters[p];
  }
  json["test"] = row.test;
  json["kind"] = name_of(row.kind);
  for (const auto& [name, value] : row.values) json[name] = to_json(value);
  json["key"] = row.key;
  return json;
}

/// The standard deviation of a single value is NaN: null in the file.
Json to_json(const statistics::Summary& s) {
  return {{"mean", s.mean}, {"std", s.standard_deviation}, {"min", s.min},
          {"max", s.max},   {"spread_rel", s.spread},      {"count", s.count}};
}

Json summary_json(const Plan& plan, const std::vector<const Row*>& rows) {
  Json json = Json::object();
  for (const Quantity& quantity : quantities_of(plan.study))
    if (const Sample sample = sample_of(rows, quantity); !sample.values.empty())
      json[quantity.name] = to_json(statistics::summarise(sample.values));
  return json;
}

Json settings_json(const Plan& plan, const RowTable& table) {
  Json json = Json::array();
  const std::vector<std::vector<const Row*>> rows = rows_by_setting(plan, table);
  for (std::size_t card = 0; card < plan.study.cards.size(); ++card)
    for (std::size_t point = 0; point < plan.points.size(); ++point) {
      Json setting;
      setting["card"] = plan.study.cards[card].name;
      setting["point"] = point + 1;
      setting["parameters"] = Json::object();
      for (std::size_t p = 0; p < table.parameters.size(); ++p)
        setting["parameters"][table.parameters[p]] = plan.points[point].values[p];
      setting["summary"] = summary_json(plan, rows[card * plan.points.size() + point]);
      json.push_back(std::move(setting));
    }
  return json;
}

std::string unit_of(const std::string& key) {
  if (const auto* measured = virtual_tests::find_measured(key)) return measured->unit;
  if (const virtual_tests::TestOption* option = virtual_tests::find_option(key))
    return std::string(dem::si_unit(option->quantity));
  if (key == "velocity") return "m/s";
  if (key == "time_step" || key == "critical_time_step") return "s";
  return "-";
}

/// "E[Pa]"; without a unit what is no number.
std::string header_of(const RowTable& table, const std::string& key) {
  for (const Row& row : table.rows)
    for (const auto& [name, value] : row.values)
      if (name == key) {
        const bool number =
            std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
        return number ? fmt::format("{}[{}]", key, unit_of(key)) : key;
      }
  return key;
}

/// Quoted where a comma, a quote or a line break would end the cell.
std::string cell(std::string text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  for (std::size_t k = 0; (k = text.find('"', k)) != std::string::npos; k += 2) text.insert(k, 1, '"');
  return '"' + text + '"';
}

std::string cell(const Value& value) {
  if (const std::string* text = std::get_if<std::string>(&value)) return cell(*text);
  if (const bool* yes = std::get_if<bool>(&value)) return *yes ? "1" : "0";
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value));
}

}  // namespace

Json result_json(const Plan& plan, const RowTable& table) {
  Json json;
  json["study"] = plan.study.name;
  json["tasks"] = {{"total", table.tasks},
                   {"done", table.rows.size()},
                   {"failed", table.failed.size()},
                   {"missing", table.tasks - table.rows.size() - table.failed.size()}};
  if (!plan.study.notes.empty()) json["notes"] = plan.study.notes;
  json["parameters"] = table.parameters;
  json["rows"] = Json::array();
  for (const Row& row : table.rows) json["rows"].push_back(row_json(table, row));
  std::vector<const Row*> all;
  for (const Row& row : table.rows) all.push_back(&row);
  json["summary"] = summary_json(plan, all);
  if (plan.cards.size() > 1) json["settings"] = settings_json(plan, table);
  json["statistics"] = statistics_json(plan, table);
  json["failed"] = Json::array();
  for (const auto& [number, message] : table.failed)
    json["failed"].push_back({{"task", number}, {"message", message}});
  return json;
}

std::string rows_csv(const Plan& plan, const RowTable& table) {
  std::vector<std::string> keys;
  for (const Row& row : table.rows)
    for (const auto& [name, value] : row.values)
      if (std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(name);
  std::string csv =
      "task,specimen,shape,seed,size_x[m],size_y[m],size_z[m],elements,element_size[m],card,point";
  for (const Parameter& parameter : plan.study.parameters)
    csv += fmt::format(",card.{}[{}]", parameter.key, dem::si_unit(parameter.kind));
  csv += ",test,kind";
  for (const std::string& key : keys) csv += fmt::format(",{}", header_of(table, key));
  csv += "\n";
  for (const Row& row : table.rows) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}", row.task, cell(row.specimen), row.shape, row.seed,
                       row.size.x(), row.size.y(), row.size.z(), row.elements, row.element_size, cell(row.card),
                       row.point);
    for (const double value : row.parameters) csv += fmt::format(",{}", value);
    csv += fmt::format(",{},{}", cell(row.test), name_of(row.kind));
    for (const std::string& key : keys) {
      const auto found =
          std::find_if(row.values.begin(), row.values.end(), [&](const auto& v) { return v.first == key; });
      csv += ',';
      if (found != row.values.end()) csv += cell(found->second);
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace study
