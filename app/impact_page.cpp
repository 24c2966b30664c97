#include "app/impact_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/impact_charts.h"
#include "app/scene_of_frames.h"
#include "report/html.h"

namespace app {
namespace {

const Json& object_of(const Json& parent, const std::string& key) {
  static const Json none = Json::object();
  const auto found = parent.find(key);
  return found != parent.end() && found->is_object() ? *found : none;
}

std::string millimetres(double metres) { return with_unit(1e3 * metres, "mm"); }

std::string verdict_of(const Json& result) {
  std::string words;
  const std::string passage = text(object_of(result, "impactor"), "passage");
  if (passage == "perforated")
    words = fmt::format("Perforated: the impactor goes on at {}. ",
                        with_unit(number(result, "residual_velocity"), "m/s"));
  else if (passage == "rebounded")
    words = fmt::format("Not perforated: the impactor went back at {}. ",
                        with_unit(-number(result, "residual_velocity"), "m/s"));
  else if (!passage.empty())
    words = fmt::format("Not perforated; when the run ended the impactor was still {}, at {}. ", passage,
                        with_unit(number(result, "residual_velocity"), "m/s"));
  std::string largest;
  double most = -1;
  for (const auto& [probe, value] : object_of(result, "max_displacement").items())
    if (value.is_number() && value.get<double>() > most) most = value.get<double>(), largest = probe;
  if (most >= 0) words += fmt::format("Largest displacement {} at {}. ", millimetres(most), largest);
  words +=
      fmt::format("{} of {} links broken.", value_words("broken_links", result.value("broken_links", Json())),
                  value_words("links", result.value("links", Json())));
  return words;
}

report::Section damage_section(const Json& result) {
  const Json &crater = object_of(result, "crater"), &scab = object_of(result, "scab"),
             &fragments = object_of(result, "fragments");
  report::KeyValues rows = rows_of(result, {"broken_links", "damage_volume"});
  const auto add = [&](const Json& object, const char* key, const std::string& words, double factor,
                       const std::string& unit) {
    if (const double value = number(object, key); std::isfinite(value))
      rows.rows.emplace_back(words, with_unit(factor * value, unit));
  };
  add(crater, "volume", "Crater in front, volume", 1e3, "dm³");
  add(crater, "depth", "Crater, depth", 1e3, "mm");
  add(crater, "equivalent_radius", "Crater, radius", 1e3, "mm");
  add(scab, "volume", "Scab behind, volume", 1e3, "dm³");
  add(scab, "depth", "Scab, depth", 1e3, "mm");
  add(scab, "equivalent_radius", "Scab, radius", 1e3, "mm");
  add(fragments, "detached", "Fragments that came off", 1, "");
  add(fragments, "single_elements", "of these, single elements (below the model's resolution)", 1, "");
  add(fragments, "detached_mass", "Their mass together", 1, "kg");
  add(fragments, "largest_mass", "The heaviest of them", 1, "kg");
  add(fragments, "highest_speed", "The fastest of them, of two elements or more", 1, "m/s");
  return {"Damage", {std::move(rows)}};
}

report::Section results_section(const Json& result) {
  report::KeyValues rows;
  rows.rows.emplace_back("Model", text(result, "model") == "coupled"
                                      ? "discrete elements in a zone, tied to finite elements around it"
                                      : "discrete elements throughout");
  for (auto& row : rows_of(result, {"perforated"}).rows) rows.rows.push_back(std::move(row));
  if (const Json& impactor = object_of(result, "impactor"); !impactor.empty()) {
    for (auto& row : rows_of(result, {"peak_force", "impulse", "residual_velocity"}).rows)
      rows.rows.push_back(std::move(row));
    rows.rows.emplace_back("The impactor at the end", text(impactor, "passage"));
    const double depth = number(impactor, "nose_depth");
    rows.rows.emplace_back(
        "Its foremost point at the end",
        millimetres(std::abs(depth)) + (depth < 0 ? " before the front face" : " behind the front face"));
    rows.rows.emplace_back("Its foremost point, at the deepest",
                           millimetres(number(impactor, "largest_nose_depth")));
  }
  for (const auto& [probe, value] : object_of(result, "max_displacement").items())
    if (value.is_number())
      rows.rows.emplace_back("Largest displacement at " + probe, millimetres(value.get<double>()));
  return {"Results", {std::move(rows)}};
}

/// "f_c [MPa] is 20, fitted to 30 to 45 (source)" for each range that the case is not in.
void add_misses(std::vector<std::string>& misses, const std::string& formula, const Json& ranges) {
  for (const Json& range : ranges)
    if (!range.value("holds", true))
      misses.push_back(fmt::format("{}: {} is {}, and it was fitted to {} to {} ({})", formula,
                                   text(range, "quantity"), with_unit(number(range, "value"), ""),
                                   with_unit(number(range, "low"), ""), with_unit(number(range, "high"), ""),
                                   text(range, "source")));
}

report::Section formulas_section(const Json& result) {
  report::Section section{"Penetration formulas beside", {}};
  const Json& formulas = object_of(result, "formulas");
  if (!formulas.value("apply", false)) {
    section.blocks.emplace_back(
        report::Text{"Modified NDRC and CEA-EDF say nothing here: " + text(formulas, "why_not") + "."});
    return section;
  }
  const auto yes = [](const Json& object, const char* key) {
    return object.value(key, false) ? std::string("yes") : std::string("no");
  };
  const Json &ndrc = object_of(formulas, "ndrc"), &cea = object_of(formulas, "cea_edf");
  const std::string wall = millimetres(number(formulas, "thickness"));
  const std::string perforated = yes(result, "perforated");
  const bool scabbed = number(object_of(result, "scab"), "volume") > 0;
  report::Table table;
  table.columns = {"formula", "quantity", "formula's value", "says", "this run", "in its range"};
  table.rows.push_back({"modified NDRC", "depth into a thick wall",
                        millimetres(number(ndrc, "penetration_depth")), "",
                        millimetres(number(object_of(result, "impactor"), "largest_nose_depth")), ""});
  table.rows.push_back(
      {"modified NDRC", "wall that is just perforated", millimetres(number(ndrc, "perforation_thickness")),
       "perforated: " + yes(ndrc, "perforates"), perforated, yes(ndrc, "perforation_in_range")});
  table.rows.push_back({"modified NDRC", "wall that just scabs",
                        millimetres(number(ndrc, "scabbing_thickness")), "scabs: " + yes(ndrc, "scabs"),
                        scabbed ? "yes" : "no", yes(ndrc, "scabbing_in_range")});
  if (!cea.empty())
    table.rows.push_back({"CEA-EDF", "velocity that just perforates this wall",
                          with_unit(number(cea, "perforation_velocity"), "m/s"),
                          "perforated: " + yes(cea, "perforates"), perforated, yes(cea, "in_range")});
  section.blocks.emplace_back(report::Text{
      fmt::format("A rigid missile of {} with a diameter of {} at {} on a wall of {}, compressive strength {}. "
                  "The formulas "
                  "are fits to tests; they stand beside the run, neither checks the other.",
                  with_unit(number(formulas, "mass"), "kg"), millimetres(number(formulas, "diameter")),
                  with_unit(number(formulas, "velocity"), "m/s"), wall,
                  with_unit(1e-6 * number(formulas, "compressive_strength"), "MPa"))});
  section.blocks.emplace_back(std::move(table));
  std::vector<std::string> misses;
  add_misses(misses, "modified NDRC, perforation", list_of(ndrc, "perforation_ranges"));
  add_misses(misses, "modified NDRC, scabbing", list_of(ndrc, "scabbing_ranges"));
  add_misses(misses, "CEA-EDF", list_of(cea, "ranges"));
  if (!misses.empty()) section.blocks.emplace_back(report::List{std::move(misses)});
  return section;
}

report::Section energy_section(const Json& result) {
  static const std::vector<std::pair<const char*, const char*>> parts = {
      {"elements", "kinetic, discrete elements"},
      {"impactor", "kinetic, impactor"},
      {"nodes", "kinetic, finite elements"},
      {"elastic", "elastic, links and contacts"},
      {"finite_elastic", "elastic, finite elements"},
      {"contact", "elastic, contacts with the impactor"},
      {"softening", "dissipated by links that soften and break"},
      {"sliding", "dissipated by sliding"},
      {"damping", "dissipated by local damping"},
      {"contact_sliding", "dissipated by sliding at the impactor"},
      {"contact_damping", "dissipated by dashpots at the impactor"},
      {"ties", "dissipated by the ties of the overlap"}};
  const Json& energy = object_of(result, "energy");
  const double initial = number(energy, "initial");
  report::Table table;
  table.columns = {"at the end", "J", "% of the first"};
  const auto add = [&](const std::string& words, double value) {
    table.rows.push_back(
        {words, report::number_text(value), initial > 0 ? report::number_text(100 * value / initial, 3) : "–"});
  };
  for (const auto& [key, words] : parts)
    if (const double value = number(energy, key); std::isfinite(value) && value != 0) add(words, value);
  add("sum", number(energy, "final"));
  add("at the start", initial);
  report::KeyValues errors{
      {{"Largest error of the balance over the run", with_unit(100 * number(energy, "balance_error"), "%", 3)},
       {"Momentum of structure, impactor and supports' impulse, error",
        report::number_text(number(result, "momentum_error"), 3)}}};
  return {"Energy", {std::move(table), std::move(errors)}};
}

}  // namespace

report::Page impact_page(const Json& result, const std::filesystem::path& folder) {
  report::Page page;
  page.title = text(result, "title").empty() ? "Impact" : "Impact: " + text(result, "title");
  page.verdict_words = verdict_of(result);
  report::List warnings;
  for (const Json& warning : list_of(result, "warnings"))
    if (warning.is_string()) warnings.items.push_back(capital(warning.get<std::string>()));
  if (!warnings.items.empty()) page.sections.push_back({"Warnings", {std::move(warnings)}});
  page.sections.push_back(results_section(result));
  page.sections.push_back(damage_section(result));
  if (auto scene = scene_of_frames(folder / "frames", "The structure and the impactor"))
    page.sections.push_back({"In space", {std::move(*scene)}});
  report::Section drawn{"Histories", {}};
  for (report::Chart& chart : impact_charts(read_columns(folder / "curves.csv")))
    drawn.blocks.emplace_back(std::move(chart));
  if (!drawn.blocks.empty()) page.sections.push_back(std::move(drawn));
  page.sections.push_back(energy_section(result));
  page.sections.push_back(formulas_section(result));
  page.sections.push_back(
      {"How it was run",
       {rows_of(result, {"elements", "fe_nodes", "links", "contacts", "multipliers", "steps", "time_step",
                         "critical_time_step", "simulated_time", "threads", "step_loop_seconds",
                         "overlap_solve_seconds", "wall_seconds", "state_sha256"})}});
  return page;
}

}  // namespace app
