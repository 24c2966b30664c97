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
    const bool stress = number(target, "target") > 1e3;
    const double factor = stress ? 1e-6 : 1;
    table.rows.push_back({target.value("name", "target"), stress ? "MPa" : "",
                          factor * number(target, "target"), factor * number(target, "achieved"),
                          number(target, "rel_error"), number(target, "tolerance"),
                          target.value("met", false)});
  }
  return table;
}

struct Column {
  std::string name, unit;
  std::vector<double> values;
};

/// A CSV of ours: "strain[-],stress[Pa]" and numbers below. Columns of text become NaN.
std::vector<Column> read_columns(const std::filesystem::path& file) {
  std::vector<Column> columns;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    const bool header = columns.empty();
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++k) {
      if (header) {
        const auto bracket = cell.find('[');
        columns.push_back({cell.substr(0, bracket), "", {}});
        if (bracket != std::string::npos)
          columns.back().unit = cell.substr(bracket + 1, cell.find(']') - bracket - 1);
      } else if (k < columns.size()) {
        char* end = nullptr;
        const double value = std::strtod(cell.c_str(), &end);
        columns[k].values.push_back(end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : value);
      }
    }
    if (!header)
      for (; k < columns.size(); ++k) columns[k].values.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  for (Column& column : columns) {
    const bool strain = column.unit == "-" && column.name.find("strain") != std::string::npos;
    const double factor = column.unit == "Pa" ? 1e-6 : strain ? 1e3 : 1;
    if (column.unit == "Pa") column.unit = "MPa";
    if (strain) column.unit = "permil";
    if (column.unit == "-") column.unit.clear();
    for (double& value : column.values) value *= factor;
  }
  return columns;
}

/// Each column over the first one; columns of one unit share a chart. Stress comes first.
report::Section curves(const std::filesystem::path& file) {
  report::Section section{"Curves", {}};
  const std::vector<Column> columns = read_columns(file);
  std::vector<std::string> units;
  for (std::size_t k = 1; k < columns.size(); ++k)
    if (std::find(units.begin(), units.end(), columns[k].unit) == units.end()) units.push_back(columns[k].unit);
  for (const std::string& unit : units) {
    report::Chart chart;
    chart.x = {columns[0].name, columns[0].unit, false, {}, {}};
    chart.y.unit = unit;
    for (std::size_t k = 1; k < columns.size(); ++k) {
      if (columns[k].unit != unit) continue;
      chart.y.title += (chart.y.title.empty() ? "" : ", ") + columns[k].name;
      report::Series series;
      series.name = columns[k].name;
      series.x = columns[0].values;
      series.y = columns[k].values;
      chart.series.push_back(std::move(series));
    }
    chart.title = chart.y.title + " over " + columns[0].name;
    section.blocks.emplace_back(std::move(chart));
  }
  return section;
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
        line += (line.empty() ? "" : " ") + (item.is_string() ? item.get<std::string>() : item.dump());
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
  if (std::filesystem::exists(folder / "curves.csv"))
    if (report::Section section = curves(folder / "curves.csv"); !section.blocks.empty())
      page.sections.push_back(std::move(section));
  if (std::filesystem::exists(folder / "run.json"))
    page.provenance = provenance(read_json(folder / "run.json"));
  report::write_page(folder / "report.html", page);
}

}  // namespace app
