#include "app/impact_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace app {
namespace {

using Values = std::vector<double>;

/// The columns of a run by name, in the units that read_columns gives them: mm, kN, MPa.
struct Histories {
  const std::vector<Column>& columns;
  Values time;  ///< [ms]

  const Values* find(const std::string& name) const {
    for (const Column& column : columns)
      if (column.name == name) return &column.values;
    return nullptr;
  }
};

double largest(const Values& values) {
  double most = 0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

Values scaled(Values values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

report::Chart chart_of(const std::string& title, const std::string& quantity, const std::string& unit) {
  report::Chart chart;
  chart.title = title;
  chart.x = {"time", "ms", false, {}, {}};
  chart.y = {quantity, unit, false, {}, {}};
  return chart;
}

void add(report::Chart& chart, const Histories& histories, const std::string& name, Values values) {
  report::Series series;
  series.name = name;
  series.x = histories.time;
  series.y = std::move(values);
  chart.series.push_back(std::move(series));
}

constexpr char axes[] = {'x', 'y', 'z'};

/// Every probe along the axis along which they move most: what a reader compares is one component.
std::optional<report::Chart> displacement_chart(const Histories& histories) {
  const std::string begin = "displacement_";
  std::vector<std::string> probes;
  for (const Column& column : histories.columns)
    if (column.name.starts_with(begin) && column.name.ends_with("_x"))
      probes.push_back(column.name.substr(begin.size(), column.name.size() - begin.size() - 2));
  if (probes.empty()) return std::nullopt;
  const auto along = [&](const std::string& probe, char axis) {
    return histories.find(begin + probe + "_" + axis);
  };
  char most = 'z';
  double reach = -1;
  for (const char axis : axes)
    for (const std::string& probe : probes)
      if (const Values* values = along(probe, axis); values != nullptr && largest(*values) > reach)
        reach = largest(*values), most = axis;
  report::Chart chart = chart_of(fmt::format("Displacement along {}", most), "displacement", "mm");
  for (const std::string& probe : probes)
    if (const Values* values = along(probe, most)) add(chart, histories, probe, *values);
  chart.caption = "Of the probes, along the axis along which they move most; curves.csv has all three.";
  return chart;
}

std::optional<report::Chart> vector_chart(const Histories& histories, const std::string& name,
                                          report::Chart chart) {
  double most = 0;
  for (const char axis : axes)
    if (const Values* values = histories.find(name + "_" + axis)) most = std::max(most, largest(*values));
  for (const char axis : axes) {
    const Values* values = histories.find(name + "_" + axis);
    // A component that is nothing beside the others is left out.
    if (values != nullptr && largest(*values) > 1e-3 * most)
      add(chart, histories, fmt::format("along {}", axis), *values);
  }
  if (chart.series.empty()) return std::nullopt;
  return chart;
}

/// Parts of one kind in one line.
std::optional<report::Chart> energy_chart(const Histories& histories) {
  struct Group {
    const char* name;
    std::vector<const char*> parts;
  };
  static const std::vector<Group> groups = {
      {"kinetic, impactor", {"impactor"}},
      {"kinetic, structure", {"elements", "nodes"}},
      {"elastic", {"elastic", "finite_elastic", "contact"}},
      {"dissipated by links that break", {"softening"}},
      {"dissipated by sliding", {"sliding", "contact_sliding"}},
      {"dissipated by damping and ties", {"damping", "contact_damping", "ties"}}};
  report::Chart chart = chart_of("Energy", "energy", "J");
  Values sum(histories.time.size(), 0.0);
  for (const Group& group : groups) {
    Values values(histories.time.size(), 0.0);
    bool there = false;
    for (const char* part : group.parts)
      if (const Values* column = histories.find(std::string("energy_") + part)) {
        there = true;
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += (*column)[k];
      }
    if (!there) continue;
    for (std::size_t k = 0; k < values.size(); ++k) sum[k] += values[k];
    add(chart, histories, group.name, std::move(values));
  }
  if (chart.series.empty()) return std::nullopt;
  add(chart, histories, "sum", std::move(sum));
  chart.series.back().kind = report::Series::Kind::dashed;
  chart.caption = "Where the energy of the impactor goes; the sum stays level if the run kept it.";
  return chart;
}

}  // namespace

std::vector<report::Chart> impact_charts(const std::vector<Column>& columns) {
  Histories histories{columns, {}};
  if (const Values* time = histories.find("time"))
    histories.time = scaled(*time, 1e3);
  else
    return {};
  std::vector<report::Chart> charts;
  const auto keep = [&](std::optional<report::Chart> chart) {
    if (chart) charts.push_back(std::move(*chart));
  };
  keep(displacement_chart(histories));
  report::Chart force = chart_of("Contact force", "force", "kN");
  force.caption = "Of the structure on the impactor, means between two samples.";
  keep(vector_chart(histories, "force", std::move(force)));
  keep(vector_chart(histories, "impulse", chart_of("Impulse on the impactor", "impulse", "N s")));
  keep(vector_chart(histories, "impactor_velocity", chart_of("Velocity of the impactor", "velocity", "m/s")));
  keep(energy_chart(histories));
  if (const Values* broken = histories.find("broken_links"); broken != nullptr && largest(*broken) > 0) {
    report::Chart chart = chart_of("Broken links", "broken links", "");
    add(chart, histories, "broken links", *broken);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace app
