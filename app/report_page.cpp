#include "app/report_page.h"

#include <fmt/format.h>

#include <utility>

#include "app/calibration_page.h"
#include "app/curve_table.h"
#include "app/impact_page.h"
#include "app/report_words.h"
#include "app/study_page.h"
#include "app/test_page.h"
#include "libdem/core/error.h"
#include "libdem/core/input_file.h"
#include "report/page.h"

namespace app {
namespace {

Json read_json(const std::filesystem::path& file) {
  constexpr std::size_t most = std::size_t{1} << 30;
  const std::string content =
      dem::content_of_input(file, most, "give the folder of a finished run: the one that its -o named");
  // What writes it again goes one call deeper for each level.
  constexpr int deepest = 100;
  const auto not_too_deep = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest)
      throw dem::InputError(file.string(), "its lists are nested more than 100 deep",
                            "give the folder of a finished run");
    return true;
  };
  try {
    return Json::parse(content, not_too_deep);
  } catch (const Json::exception&) {
    throw dem::InputError(file.string(), "this is not JSON", "give the folder of a finished run");
  }
}

/// A run of a kind that has no page of its own: its numbers, its lists as tables, its curves.
report::Page plain_page(const Json& result, const std::filesystem::path& curves) {
  report::Page page;
  page.title = "Run";
  report::KeyValues numbers;
  for (const auto& [key, value] : result.items())
    if (value.is_primitive()) numbers.rows.emplace_back(label_of(key).words, value_words(key, value));
  page.sections.push_back({"Results", {std::move(numbers)}});
  for (const auto& [name, list] : result.items()) {
    if (!list.is_array() || list.empty() || !list.front().is_object()) continue;
    report::Table table;
    std::vector<std::string> keys;
    for (const auto& [key, value] : list.front().items())
      if (value.is_primitive()) keys.push_back(key);
    for (const std::string& key : keys) table.columns.push_back(label_of(key).words);
    for (const Json& item : list) {
      table.rows.emplace_back();
      for (const std::string& key : keys)
        table.rows.back().push_back(item.contains(key) ? value_words(key, item[key]) : "");
    }
    page.sections.push_back({label_of(name).words, {std::move(table)}});
  }
  report::Section drawn{"Curves", {}};
  for (report::Chart& chart : charts_of(read_columns(curves))) drawn.blocks.emplace_back(std::move(chart));
  if (!drawn.blocks.empty()) page.sections.push_back(std::move(drawn));
  return page;
}

/// A result of no kind that is known may be one of a later Spall, but not anything at all.
void require_some_run(const Json& result, const std::filesystem::path& folder) {
  const std::filesystem::path provenance = folder / "run.json";
  const bool ours = result.is_object() && !result.empty() && std::filesystem::exists(provenance) &&
                    read_json(provenance).contains("command_line");
  if (!ours)
    throw dem::InputError((folder / "result.json").string(), "this is no result of a run that Spall knows",
                          "give the folder of a finished run, as the run left it");
}

void add_provenance(report::Page& page, const Json& run) {
  auto& rows = page.provenance;
  for (const auto& [key, value] : run.items()) {
    if (key == "inputs" && value.is_array()) {
      for (const Json& input : value)
        rows.emplace_back("input " + text(input, "file") + ", SHA-256", text(input, "sha256"));
    } else if (value.is_array()) {
      std::string line;
      for (const Json& item : value)
        line.append(line.empty() ? "" : " ").append(item.is_string() ? item.get<std::string>() : item.dump());
      rows.emplace_back(label_of(key).words, line);
    } else if (value.is_object()) {
      for (const auto& [name, item] : value.items())
        rows.emplace_back(label_of(key).words + ": " + label_of(name).words, value_words(name, item));
    } else {
      rows.emplace_back(label_of(key).words, value_words(key, value));
    }
  }
}

}  // namespace

report::Page page_of_run(const std::filesystem::path& folder) {
  const Json result = read_json(folder / "result.json");
  const std::filesystem::path curves = folder / "curves.csv";
  const std::string name = std::filesystem::absolute(folder / ".").lexically_normal().parent_path().filename();
  report::Page page;
  try {
    if (!text(result, "test").empty()) {
      page = test_page(result, folder);
      page.title = "Virtual test: " + text(result, "test");
      page.subtitle = name;
    } else if (result.contains("card") && result.contains("targets")) {
      page = calibration_page(result, folder);
    } else if (result.contains("model") && result.contains("max_displacement")) {
      page = impact_page(result, folder);
      page.subtitle = name;
    } else if (result.contains("study") && result.contains("rows")) {
      page = study_page(result);
      page.subtitle = name;
    } else {
      require_some_run(result, folder);
      page = plain_page(result, curves);
      page.subtitle = name;
    }
  } catch (const Json::exception& error) {
    throw dem::InputError((folder / "result.json").string(),
                          fmt::format("a key holds something else than it should ({})", error.what()),
                          "give the folder of a finished run, as the run left it");
  }
  if (std::filesystem::exists(folder / "run.json")) add_provenance(page, read_json(folder / "run.json"));
  return page;
}

void write_report(const std::filesystem::path& folder) {
  report::write_page(folder / "report.html", page_of_run(folder));
}

}  // namespace app
