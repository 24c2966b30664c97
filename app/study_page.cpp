#include "app/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study_statistics_page.h"

namespace app {
namespace {

report::Table summary_table(const Json& summary) {
  report::Table table{
      {"quantity", "unit", "tests", "mean", "standard deviation", "smallest", "largest", "spread"}, {}};
  for (const auto& [name, s] : summary.items()) {
    const Label label = label_of_quantity(name);
    const auto shown = [&, &s = s](const char* key) { return with_unit(label.factor * number(s, key), ""); };
    table.rows.push_back({capital(label.words), label.unit, with_unit(number(s, "count"), "", 15),
                          shown("mean"), shown("std"), shown("min"), shown("max"),
                          with_unit(100 * number(s, "spread_rel"), "%", 3)});
  }
  return table;
}

std::vector<std::string> tests_of(const Json& rows) {
  std::vector<std::string> tests;
  for (const Json& row : rows)
    if (std::find(tests.begin(), tests.end(), text(row, "test")) == tests.end())
      tests.push_back(text(row, "test"));
  return tests;
}

std::string size_words(const Json& row) {
  std::string words;
  for (const Json& side : list_of(row, "size"))
    words += (words.empty() ? "" : " × ") + with_unit(side.get<double>(), "", 4);
  return words + " m";
}

std::string setting_of(const Json& row) {
  std::string words;
  if (const auto found = row.find("parameters"); found != row.end())
    for (const auto& [key, value] : found->items())
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", key, value_words(key, value));
  return words;
}

report::Table rows_table(const Json& rows, const std::string& test, bool several_settings) {
  static const std::vector<std::string> wanted{
      "peak_stress", "peak_strain", "E", "nu", "work_of_fracture", "damage", "unbalanced_force_ratio"};
  report::Table table{{"task", "specimen", "seed", "size", "elements"}, {}};
  if (several_settings) table.columns.insert(table.columns.end(), {"card", "setting"});
  std::vector<std::string> keys;
  for (const std::string& key : wanted)
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const Json& row) { return text(row, "test") == test && row.contains(key); }))
      keys.push_back(key);
  for (const std::string& key : keys) table.columns.push_back(label_of(key).words);
  for (const Json& row : rows) {
    if (text(row, "test") != test) continue;
    std::vector<std::string> cells{value_words("task", row.at("task")), text(row, "specimen"),
                                   value_words("seed", row.at("seed")), size_words(row),
                                   value_words("elements", row.at("elements"))};
    if (several_settings) cells.insert(cells.end(), {text(row, "card"), setting_of(row)});
    for (const std::string& key : keys) cells.push_back(row.contains(key) ? value_words(key, row[key]) : "");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace

report::Page study_page(const Json& result) {
  report::Page page;
  page.title = "Study: " + text(result, "study");
  const Json& tasks = result.at("tasks");
  const double total = number(tasks, "total"), done = number(tasks, "done");
  page.verdict = done == total ? report::Verdict::neutral : report::Verdict::not_met;
  page.verdict_words = fmt::format("{:.0f} of {:.0f} tasks have a result. ", done, total);
  const Json& summary = result.at("summary");
  for (const char* name : {"E", "nu", "ft", "fc"})
    if (const auto found = summary.find(name); found != summary.end()) {
      const Label label = label_of_quantity(name);
      page.verdict_words += fmt::format("{}: {}, spread {}. ", capital(label.words),
                                        with_unit(label.factor * number(*found, "mean"), label.unit),
                                        with_unit(100 * number(*found, "spread_rel"), "%", 2));
    }
  page.sections.push_back(
      {"Summary",
       {report::Text{"Over all rows. The spread is the largest value less the smallest, over "
                     "the mean; the standard deviation divides by n - 1."},
        summary_table(summary)}});
  for (report::Section& section : statistics_sections(result)) page.sections.push_back(std::move(section));
  const bool several = result.contains("settings");
  const Json& rows = list_of(result, "rows");
  for (const std::string& test : tests_of(rows))
    page.sections.push_back({capital(test), {rows_table(rows, test, several)}});
  if (const Json& failed = list_of(result, "failed"); !failed.empty()) {
    report::List list;
    for (const Json& failure : failed)
      list.items.push_back(
          fmt::format("task {}: {}", failure.at("task").get<std::size_t>(), text(failure, "message")));
    page.sections.push_back({"Failed", {std::move(list)}});
  }
  return page;
}

}  // namespace app
