#include "app/test_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/curve_table.h"
#include "app/scene_of_frames.h"
#include "report/html.h"
#include "specimens/virtual_tests/catalogue.h"

namespace app {
namespace {

const Column* column(const std::vector<Column>& columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

report::Series series(const std::string& name, const Column& x, const Column& y, int colour,
                      report::Series::Kind kind = report::Series::Kind::line) {
  report::Series line;
  line.name = name;
  line.kind = kind;
  line.x = x.values;
  line.y = y.values;
  line.colour = colour;
  return line;
}

/// Stress over the axial strain to the one side and the lateral strain to the other, as laboratories draw it.
report::Chart stress_chart(const std::vector<Column>& columns, bool compression) {
  const Column *platens = column(columns, "strain"), *stress = column(columns, "stress"),
               *axial = column(columns, "strain_axial"), *lateral = column(columns, "strain_lateral");
  report::Chart chart;
  chart.title = "Stress over strain";
  chart.x = {"strain", "‰", false, {}, {}};
  chart.y = {"stress", "MPa", false, {}, {}};
  chart.series.push_back(series("axial, between the platens", *platens, *stress, 0));
  if (axial != nullptr)
    chart.series.push_back(
        series("axial, of the gauge inside", *axial, *stress, 2, report::Series::Kind::dashed));
  if (lateral != nullptr)
    chart.series.push_back(
        series("lateral, of the gauge inside", *lateral, *stress, 1, report::Series::Kind::dashed));
  if (const auto peak = std::max_element(stress->values.begin(), stress->values.end());
      peak != stress->values.end()) {
    report::Series mark;
    mark.name = "peak";
    mark.kind = report::Series::Kind::points;
    mark.x = {platens->values[static_cast<std::size_t>(peak - stress->values.begin())]};
    mark.y = {*peak};
    mark.colour = 0;
    chart.series.push_back(std::move(mark));
  }
  chart.caption =
      compression
          ? "Compression and shortening are positive; lateral expansion is negative, to the left."
          : "Tension and elongation are positive; lateral contraction is negative, to the left. After the "
            "peak the gauge sees the crack only if it runs through the gauge.";
  return chart;
}

report::Chart damage_chart(const std::vector<Column>& columns) {
  const Column *control = &columns.front(), *broken = column(columns, "broken"),
               *unbalanced = column(columns, "unbalanced");
  const auto percent = [](Column values) {
    for (double& value : values.values) value *= 100;
    return values;
  };
  report::Chart chart;
  chart.title = "Damage and balance";
  chart.x = {control->name == "strain" ? "axial strain between the platens" : control->name,
             control->unit,
             false,
             {},
             {}};
  chart.y = {"part", "%", false, {}, {}};
  chart.series.push_back(series("links broken, of all", *control, percent(*broken), 0));
  if (unbalanced != nullptr)
    chart.series.push_back(series("difference of the forces that balance, of their mean", *control,
                                  percent(*unbalanced), 5, report::Series::Kind::dashed));
  return chart;
}

/// Whether it was balanced and ran to its end.
std::string how_it_went(const Json& result) {
  if (!result.contains("quasi_static"))  // a dynamic test
    return result.value("passed_peak", true) ? "" : "The bar did not break.";
  if (!result.value("passed_peak", true)) return "The test ended at its limit before the peak was passed.";
  if (number(result, "energy_balance_error") > 0.01)
    return fmt::format("The energy balance is open by {}; lower the time step fraction.",
                       with_unit(100 * number(result, "energy_balance_error"), "%", 3));
  if (!result.value("quasi_static", true))
    return fmt::format("Not quasi-static: the forces that balance differ by {}; load it slower.",
                       with_unit(100 * number(result, "unbalanced_force_ratio"), "%", 3));
  return "The test was quasi-static.";
}

/// Curve of a laboratory test: stress over what is driven, and every other quantity over it too.
void add_charts(report::Section& drawn, const std::vector<Column>& columns) {
  std::vector<Column> own;
  for (const Column& one : columns)
    if (one.name != "broken" && one.name != "unbalanced") own.push_back(one);
  for (report::Chart& chart : charts_of(own)) drawn.blocks.emplace_back(std::move(chart));
}

}  // namespace

report::Page test_page(const Json& result, const std::filesystem::path& folder) {
  report::Page page;
  const virtual_tests::TestDescription* test = virtual_tests::find_test(text(result, "test"));
  const bool uniaxial = result.contains("peak_stress") && result.contains("peak_strain");
  if (!uniaxial && result.contains("passed_peak") && test != nullptr) {
    const std::string& main = test->measured.front().key;
    const bool good = result.value("passed_peak", true) && result.value("quasi_static", true);
    page.verdict = good ? report::Verdict::neutral : report::Verdict::not_met;
    page.verdict_words = fmt::format("{}: {}. {}", capital(label_of(main).words),
                                     value_words(main, result.value(main, Json())), how_it_went(result));
  } else if (uniaxial) {
    const bool good = result.value("passed_peak", true) && result.value("quasi_static", true);
    page.verdict = good ? report::Verdict::neutral : report::Verdict::not_met;
    page.verdict_words =
        fmt::format("Peak stress {} at a strain of {}. ", value_words("peak_stress", result["peak_stress"]),
                    with_unit(1e3 * number(result, "peak_strain"), "‰"));
    page.verdict_words += how_it_went(result);
  } else if (result.contains("E")) {
    page.verdict_words =
        fmt::format("E = {}, ν = {}", value_words("E", result["E"]), value_words("nu", result["nu"]));
  }
  report::KeyValues measured;
  const auto show = [&](const std::string& key) {
    if (const auto found = result.find(key); found != result.end() && found->is_primitive())
      measured.rows.emplace_back(capital(label_of(key).words), value_words(key, *found));
  };
  if (test != nullptr)
    for (const virtual_tests::MeasuredQuantity& quantity : test->measured) show(quantity.key);
  show("broken_links"), show("damage");
  page.sections.push_back({"Results", {std::move(measured)}});
  const std::vector<Column> columns = read_columns(folder / "curves.csv");
  const bool compressed = text(result, "test") == "compression" || text(result, "test") == "triaxial" ||
                          text(result, "loading") == "compression";
  report::Section drawn{"Curves", {}};
  if (column(columns, "strain") != nullptr && column(columns, "stress") != nullptr) {
    drawn.blocks.emplace_back(stress_chart(columns, compressed));
  } else if (!columns.empty()) {
    add_charts(drawn, columns);
  }
  if (!columns.empty() && column(columns, "broken") != nullptr)
    drawn.blocks.emplace_back(damage_chart(columns));
  if (!drawn.blocks.empty()) page.sections.push_back(std::move(drawn));
  if (auto scene = scene_of_frames(folder / "frames", "The specimen"))
    page.sections.push_back({"In space", {std::move(*scene)}});
  report::KeyValues run = rows_of(result, {"elements", "links"});
  if (test != nullptr)
    for (const virtual_tests::TestOption& option : test->options) {
      const auto found = result.find(option.key);
      const bool later = option.key == "velocity" || option.key == "damping";
      if (found != result.end() && found->is_primitive() && !later)
        run.rows.emplace_back(capital(label_of(option.key).words), value_words(option.key, *found));
    }
  for (auto& row :
       rows_of(result, {"velocity", "damping", "passed_peak", "quasi_static", "unbalanced_force_ratio",
                        "energy_balance_error", "steps", "time_step", "critical_time_step", "iterations",
                        "threads", "step_loop_seconds", "wall_seconds", "state_sha256"})
           .rows)
    run.rows.push_back(std::move(row));
  if (const auto check = result.find("rate_check"); check != result.end() && check->is_object()) {
    const std::string quantity = text(*check, "quantity");
    run.rows.emplace_back(capital(label_of(quantity).words) + " at half the speed",
                          fmt::format("{} ({:+.2f}%)", value_words(quantity, check->value("value", Json())),
                                      100 * number(*check, "change")));
  }
  page.sections.push_back({"How it was run", {std::move(run)}});
  return page;
}

}  // namespace app
