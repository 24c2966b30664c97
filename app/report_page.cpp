#include "app/report_page.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/curve_table.h"
#include "libdem/core/error.h"
#include "report/page.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw dem::InputError(file.string(), "there is no such file",
                          "give the folder of a finished run: the one that its -o named");
  try {
    return Json::parse(in);
  } catch (const Json::exception&) {
    throw dem::InputError(file.string(), "this is not JSON", "give the folder of a finished run");
  }
}

/// How a key of result.json is shown: a unit that people use, and the factor into it.
struct Shown {
  const char* unit;
  double factor;
};
Shown shown(const std::string& key) {
  static const std::map<std::string, Shown> known{{"E", {"GPa", 1e-9}},
                                                  {"T", {"MPa", 1e-6}},
                                                  {"Co", {"MPa", 1e-6}},
                                                  {"peak_stress", {"MPa", 1e-6}},
                                                  {"peak_strain", {"permil", 1e3}},
                                                  {"velocity", {"m/s", 1}},
                                                  {"time_step", {"us", 1e6}},
                                                  {"critical_time_step", {"us", 1e6}},
                                                  {"wall_seconds", {"s", 1}},
                                                  {"step_loop_seconds", {"s", 1}},
                                                  {"work_of_fracture", {"N/m", 1}},
                                                  {"phi_i", {"degree", 180 / 3.14159265358979323846}},
                                                  {"phi_c", {"degree", 180 / 3.14159265358979323846}},
                                                  {"density", {"kg/m3", 1}}};
  const auto found = known.find(key);
  return found == known.end() ? Shown{"", 1} : found->second;
}

std::string words(const std::string& key, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number()) {
    const Shown as = shown(key);
    const std::string number =
        value.is_number_float() ? fmt::format("{:.5g}", as.factor * value.get<double>()) : value.dump();
    return *as.unit == 0 ? number : number + " " + as.unit;
  }
  return value.dump();
}

report::KeyValues key_values(const Json& object) {
  report::KeyValues table;
  for (const auto& [key, value] : object.items())
    if (value.is_primitive()) table.rows.emplace_back(key, words(key, value));
  return table;
}

double number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>()
                                                     : std::numeric_limits<double>::quiet_NaN();
}

report::Targets targets(const Json& list) {
  report::Targets table;
  for (const Json& target : list) {
    // Shown in the unit that the run names: value / scale.
    const double scale = target.value("scale", 1.0);
    table.rows.push_back({target.value("words", target.value("name", "target")), target.value("unit", ""),
                          number(target, "target") / scale, number(target, "achieved") / scale,
                          number(target, "rel_error"), number(target, "tolerance"),
                          target.value("met", false)});
  }
  return table;
}

/// A list of objects as a table: one row each, the columns of the first one.
report::Table rows_of(const Json& list) {
  report::Table table;
  for (const auto& [key, value] : list.front().items())
    if (value.is_primitive() && key != "sha256") table.columns.push_back(key);
  for (const Json& item : list) {
    table.rows.emplace_back();
    for (const std::string& key : table.columns)
      table.rows.back().push_back(item.contains(key) ? words(key, item[key]) : "");
  }
  return table;
}

std::vector<std::pair<std::string, std::string>> provenance(const Json& run) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const auto& [key, value] : run.items()) {
    if (key == "inputs" && value.is_array()) {
      for (const Json& input : value)
        rows.emplace_back("input " + input.value("file", "?"), "SHA-256 " + input.value("sha256", "?"));
    } else if (value.is_array()) {
      std::string line;
      for (const Json& item : value)
        line.append(line.empty() ? "" : " ").append(item.is_string() ? item.get<std::string>() : item.dump());
      rows.emplace_back(key, line);
    } else if (value.is_object()) {
      for (const auto& [name, item] : value.items()) rows.emplace_back(key + " " + name, words(name, item));
    } else {
      rows.emplace_back(key, words(key, value));
    }
  }
  return rows;
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
  const Json result = read_json(folder / "result.json");
  report::Page page;
  const std::string test = result.value("test", "");
  page.title = !test.empty()             ? fmt::format("Virtual test: {}", test)
               : result.contains("card") ? "Calibration"
                                         : "Run";
  page.subtitle = std::filesystem::absolute(folder).lexically_normal().filename().string();
  report::Section numbers{"Results", {}};
  if (const auto list = result.find("targets"); list != result.end() && list->is_array() && !list->empty()) {
    const report::Targets table = targets(*list);
    std::size_t met = 0;
    for (const report::Target& target : table.rows) met += target.met ? 1u : 0u;
    page.verdict = met == table.rows.size() ? report::Verdict::met : report::Verdict::not_met;
    page.verdict_words = fmt::format("{} of {} targets met within their tolerance", met, table.rows.size());
    numbers.blocks.emplace_back(table);
  }
  if (result.contains("card") && result["card"].is_object())
    page.sections.push_back({"Material card", {key_values(result["card"])}});
  numbers.blocks.emplace_back(key_values(result));
  page.sections.insert(page.sections.begin(), std::move(numbers));
  for (const auto& [key, title] :
       {std::pair("specimens", "Specimens"), std::pair("parameters", "What the data determine")})
    if (const auto list = result.find(key); list != result.end() && list->is_array() && !list->empty())
      page.sections.push_back({title, {rows_of(*list)}});
  if (const auto list = result.find("warnings"); list != result.end() && list->is_array() && !list->empty()) {
    report::Section section{"Warnings", {}};
    for (const Json& warning : *list) section.blocks.emplace_back(report::Text{warning.get<std::string>()});
    page.sections.push_back(std::move(section));
  }
  report::Section drawn{"Curves", {}};
  if (std::filesystem::exists(folder / "curves.csv"))
    for (report::Chart& chart : read_charts(folder / "curves.csv")) drawn.blocks.emplace_back(std::move(chart));
  if (!drawn.blocks.empty()) page.sections.push_back(std::move(drawn));
  if (std::filesystem::exists(folder / "run.json"))
    page.provenance = provenance(read_json(folder / "run.json"));
  report::write_page(folder / "report.html", page);
}

}  // namespace app
