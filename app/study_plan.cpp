#include "app/study_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "app/console.h"
#include "study/estimate.h"
#include "study/plan_key.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t most_lines = 60;

std::string value_in_words(const study::Parameter& parameter, double value) {
  constexpr double degree = 3.14159265358979323846 / 180;
  if (parameter.kind == dem::Quantity::stress)
    return value >= 1e9 ? fmt::format("{:.4g} GPa", value / 1e9) : fmt::format("{:.4g} MPa", value / 1e6);
  if (parameter.kind == dem::Quantity::angle) return fmt::format("{:.4g} degree", value / degree);
  if (parameter.kind == dem::Quantity::ratio) return fmt::format("{:.4g}", value);
  return fmt::format("{:.4g} {}", value, dem::si_unit(parameter.kind));
}

/// What is to be computed: tasks that share a result count once.
struct Totals {
  std::size_t results = 0, packed = 0;
  double seconds = 0, longest = 0, bytes = 0;
};

Totals totals_of(const study::Plan& plan) {
  Totals totals;
  std::set<std::string> keys;
  for (const study::Task& task : plan.tasks) {
    if (!keys.insert(task.key).second) continue;
    totals.seconds += task.seconds;
    totals.longest = std::max(totals.longest, task.seconds);
    totals.bytes = std::max(totals.bytes, task.bytes);
  }
  totals.results = keys.size();
  for (const study::SpecimenRecipe& recipe : plan.study.specimens)
    if (recipe.file.empty()) {
      ++totals.packed;
      totals.seconds += study::estimate_packing(recipe.packing).seconds;
    }
  return totals;
}

double wall_seconds(const Totals& totals, int threads) {
  return std::max(totals.longest, totals.seconds / threads);
}

}  // namespace

std::string setting_words(const study::Plan& plan, const study::Task& task) {
  std::string words;
  for (std::size_t p = 0; p < plan.study.parameters.size(); ++p)
    words += fmt::format("{}{} = {}", p == 0 ? "" : ", ", plan.study.parameters[p].key,
                         value_in_words(plan.study.parameters[p], plan.points[task.point].values[p]));
  return words;
}

std::vector<std::string> plan_lines(const study::Plan& plan, int threads) {
  std::vector<std::string> lines;
  for (const study::Task& task : plan.tasks) {
    if (lines.size() == most_lines) {
      lines.push_back(fmt::format("... and {} more; --json lists them all", plan.tasks.size() - most_lines));
      break;
    }
    const study::SpecimenRecipe& recipe = plan.specimen_of(task);
    std::string line =
        fmt::format("{:>5}  {} ({} elements)", task.number, study::label_of(recipe), recipe.packing.elements);
    if (plan.study.cards.size() > 1) line += fmt::format(", {}", plan.study.cards[task.card].name);
    if (const std::string setting = setting_words(plan, task); !setting.empty()) line += ", " + setting;
    line += fmt::format(": {}, about {}", plan.test_of(task).name, duration(task.seconds));
    lines.push_back(std::move(line));
  }
  const Totals totals = totals_of(plan);
  std::string what = fmt::format("{} tasks", plan.tasks.size());
  if (totals.results != plan.tasks.size()) what += fmt::format(" with {} results", totals.results);
  if (totals.packed > 0) what += fmt::format(", {} specimens to pack", totals.packed);
  lines.push_back(fmt::format("{}: about {} on {} thread{}, the longest {}; up to {:.2g} GB each", what,
                              duration(wall_seconds(totals, threads)), threads, threads == 1 ? "" : "s",
                              duration(totals.longest), totals.bytes / 1e9));
  return lines;
}

Json plan_json(const study::Plan& plan, int threads) {
  Json json;
  json["name"] = plan.study.name;
  json["tasks"] = Json::array();
  for (const study::Task& task : plan.tasks) {
    const study::SpecimenRecipe& recipe = plan.specimen_of(task);
    Json row;
    row["task"] = task.number;
    row["specimen"] = recipe.group;
    row["seed"] = recipe.packing.seed;
    row["elements"] = recipe.packing.elements;
    row["card"] = plan.study.cards[task.card].name;
    row["point"] = task.point + 1;
    row["parameters"] = Json::object();
    for (std::size_t p = 0; p < plan.study.parameters.size(); ++p)
      row["parameters"][plan.study.parameters[p].key] = plan.points[task.point].values[p];
    row["test"] = plan.test_of(task).name;
    row["key"] = task.key;
    row["seconds"] = task.seconds;
    row["bytes"] = task.bytes;
    json["tasks"].push_back(std::move(row));
  }
  const Totals totals = totals_of(plan);
  json["estimate"] = {{"core_seconds", totals.seconds},
                      {"wall_seconds", wall_seconds(totals, threads)},
                      {"longest_seconds", totals.longest},
                      {"bytes_per_task", totals.bytes},
                      {"threads", threads},
                      {"results", totals.results},
                      {"specimens_to_pack", totals.packed}};
  return json;
}

}  // namespace app
