#include "app/study_statistics_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace app {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
using Kind = report::Series::Kind;

const Json& object_of(const Json& parent, const std::string& key) {
  static const Json none = Json::object();
  const auto found = parent.find(key);
  return found != parent.end() && found->is_object() ? *found : none;
}

std::string percent(double share, int digits = 2) { return with_unit(100 * share, "%", digits); }

std::string p_cell(const Json& object, const char* key = "p") {
  const double p = number(object, key);
  return !std::isfinite(p) ? "" : p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p);
}

std::string interval_words(const Json& interval, double factor, const std::string& unit) {
  if (!interval.is_array() || interval.size() != 2 || !interval[0].is_number() || !interval[1].is_number())
    return "";
  return fmt::format("{} to {}", with_unit(factor * interval[0].get<double>(), ""),
                     with_unit(factor * interval[1].get<double>(), unit));
}

bool is_main(const std::string& name) { return name.find('.') == std::string::npos; }

/// Each specimen's value, group beside group, and the band from the smallest to the largest.
report::Chart scatter_chart(const Json& result, const std::string& name) {
  const Label label = label_of_quantity(name);
  const bool elastic = name == "E" || name == "nu";
  const char* kind = elastic ? "elastic" : name == "ft" ? "tension" : "compression";
  const std::string key = elastic ? name : "peak_stress";
  report::Chart chart;
  chart.title = capital(label.words);
  chart.x = {"specimen, in the study's order", "", false, {}, {}};
  chart.y = {label.words, label.unit, false, {}, {}};
  std::vector<report::Series> groups;
  double count = 0;
  for (const Json& row : list_of(result, "rows")) {
    if (text(row, "test") != kind) continue;
    const std::string group = text(row, "specimen");
    auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& s) { return s.name == group; });
    if (found == groups.end()) {
      groups.emplace_back();
      found = groups.end() - 1;
      found->name = group, found->kind = Kind::points;
    }
    found->x.push_back(++count);
    found->y.push_back(label.factor * number(row, key));
  }
  const Json& summary = object_of(object_of(result, "summary"), name);
  report::Series band{"smallest to largest",
                      Kind::band,
                      {0.5, count + 0.5},
                      std::vector<double>(2, label.factor * number(summary, "min")),
                      std::vector<double>(2, label.factor * number(summary, "max"))};
  report::Series mean{
      "mean", Kind::dashed, {0.5, count + 0.5}, std::vector<double>(2, label.factor * number(summary, "mean"))};
  mean.thin = true;
  chart.series.push_back(std::move(band));
  chart.series.push_back(std::move(mean));
  for (report::Series& group : groups) chart.series.push_back(std::move(group));
  const Json& interval =
      object_of(object_of(object_of(result, "statistics"), "quantities"), name).value("mean_interval", Json());
  chart.caption = fmt::format("Spread {} of the mean.", percent(number(summary, "spread_rel")));
  if (const std::string words = interval_words(interval, label.factor, label.unit); !words.empty())
    chart.caption += fmt::format(" The mean lies between {} with 95% confidence (bootstrap).", words);
  return chart;
}

report::Section scatter_section(const Json& result) {
  report::Section section{"Scatter", {}};
  for (const auto& [name, entry] : object_of(object_of(result, "statistics"), "quantities").items())
    if (is_main(name) && entry.contains("mean_interval"))
      section.blocks.emplace_back(scatter_chart(result, name));
  return section;
}

report::Section effects_section(const Json& quantities) {
  report::Section section{"Effects beyond the scatter", {}};
  report::List words;
  report::Table factors{{"quantity", "factor", "F", "degrees", "p", "share of the variance"}, {}};
  report::Table others{{"quantity", "specimen", "from the reference's mean", "p", "p, all asked at once"}, {}};
  std::string reference, visible;
  for (const auto& [name, entry] : quantities.items()) {
    if (!is_main(name)) continue;
    const std::string quantity = capital(label_of_quantity(name).words);
    if (const Json& effect = object_of(entry, "effect_of_groups"); !effect.empty())
      words.items.push_back(quantity + ": " + text(effect, "words"));
    for (const Json& factor : list_of(entry, "factors")) {
      const Json& degrees = list_of(factor, "degrees");
      factors.rows.push_back({quantity, label_of(text(factor, "factor")).words,
                              with_unit(number(factor, "F"), "", 3),
                              fmt::format("{}, {}", degrees.at(0).dump(), degrees.at(1).dump()), p_cell(factor),
                              percent(number(factor, "eta_squared"), 3)});
    }
    if (const Json& against = object_of(entry, "against_reference"); !against.empty()) {
      reference = text(against, "reference");
      visible += fmt::format("{}{} {}", visible.empty() ? "" : ", ", label_of_quantity(name).words,
                             percent(number(against, "smallest_visible_deviation")));
      for (const Json& one : list_of(against, "specimens"))
        others.rows.push_back({quantity, text(one, "specimen"), percent(number(one, "deviation"), 3),
                               p_cell(one), p_cell(one, "p_holm")});
    }
  }
  if (words.items.empty() && factors.rows.empty()) return section;
  section.blocks.emplace_back(report::Text{
      "An analysis of variance asks whether a factor changes a quantity by more than specimens of one kind "
      "differ among themselves. p is how often scatter alone would show as much; below 0.05 an effect "
      "counts as shown. \"Not shown\" is not \"none\"."});
  if (!words.items.empty()) section.blocks.emplace_back(std::move(words));
  if (!factors.rows.empty()) section.blocks.emplace_back(std::move(factors));
  if (!others.rows.empty()) {
    section.blocks.emplace_back(report::Text{fmt::format(
        "Kinds with a single specimen, each against the scatter of {}. A single specimen would stand "
        "out (p below 0.05) from a deviation of: {}.",
        reference, visible)});
    section.blocks.emplace_back(std::move(others));
  }
  return section;
}

report::Section card_section(const Json& errors) {
  report::Table table{{"card", "tests", "E, mean error", "E, largest", "ν, mean error", "ν, largest"}, {}};
  for (const Json& entry : errors) {
    const Json &E = object_of(entry, "E"), &nu = object_of(entry, "nu");
    table.rows.push_back({text(entry, "card"), entry.at("tests").dump(), percent(number(E, "mean")),
                          percent(number(E, "largest")), percent(number(nu, "mean")),
                          percent(number(nu, "largest"))});
  }
  return {"E and ν against the card", {std::move(table)}};
}

struct Constants {
  std::string name;
  double alpha, beta, gamma;
};

void add_eq1(report::Chart& stiffness, report::Chart& poisson, const Constants& c, Kind kind) {
  report::Series E{c.name, kind, {}, {}}, nu = E;
  const auto at = [&](double r) { return (c.beta + c.gamma * r) / (c.alpha + r); };
  for (int k = 0; k <= 60; ++k) {
    const double r = k / 60.0;
    E.x.push_back(r), E.y.push_back(at(r) / at(1));
    nu.x.push_back(r), nu.y.push_back((1 - r) / (c.alpha + r));
  }
  stiffness.series.push_back(std::move(E));
  poisson.series.push_back(std::move(nu));
}

report::Section eq1_section(const Json& fit) {
  report::Chart stiffness, poisson;
  stiffness.title = "E/E0 over Ks/Kn (Fig. 4)", poisson.title = "ν over Ks/Kn (Fig. 4)";
  stiffness.x = poisson.x = {"Ks/Kn", "", false, {}, {}};
  stiffness.y = {"E/E0", "", false, {}, {}}, poisson.y = {"Poisson's ratio", "", false, {}, {}};
  const Constants own{"fitted", number(fit, "alpha"), number(fit, "beta"), number(fit, "gamma")};
  add_eq1(stiffness, poisson, own, Kind::line);
  add_eq1(stiffness, poisson, {"paper (Eq. 3)", 3.7, 2.198, 3.79}, Kind::dashed);
  add_eq1(stiffness, poisson, {"Hentz (Eq. 4)", 2.5, 2.0, 2.65}, Kind::dashed);
  const Json& points = list_of(fit, "points");
  // E0 belongs to Ks/Kn = 1; without a test there the fit gives it.
  double E0 = (own.beta + own.gamma) / (own.alpha + 1);
  for (const Json& point : points)
    if (number(point, "Ks_over_Kn") > 1 - 1e-9) E0 = number(point, "stiffness");
  report::Series E{"tests, mean", Kind::points, {}, {}}, nu = E;
  for (const Json& point : points) {
    E.x.push_back(number(point, "Ks_over_Kn")), E.y.push_back(number(point, "stiffness") / E0);
    nu.x.push_back(number(point, "Ks_over_Kn")), nu.y.push_back(number(point, "nu"));
  }
  stiffness.series.push_back(std::move(E)), poisson.series.push_back(std::move(nu));
  const auto with_error = [&](const char* key, const char* error) {
    return fmt::format("{:.3f} ± {:.3f}", number(fit, key), number(fit, error));
  };
  report::KeyValues values{{{"α", with_error("alpha", "alpha_std")},
                            {"β", with_error("beta", "beta_std")},
                            {"γ", with_error("gamma", "gamma_std")},
                            {"E, root mean square left", percent(number(fit, "stiffness_rms"))},
                            {"ν, root mean square left", with_unit(number(fit, "poisson_rms"), "", 2)}}};
  return {"Eq. 1 fitted", {std::move(values), std::move(stiffness), std::move(poisson)}};
}

report::Section orientation_section(const Json& kinds) {
  report::Table table{{"specimens", "number", "links", "smallest eigenvalue", "largest", "scatter of the cells",
                       "of random directions"},
                      {}};
  report::Chart chart;
  chart.title = "Links by direction (Fig. 2)";
  chart.x = {"angle around the long axis", "°", false, 0.0, 360.0};
  chart.y = {"links, over an even distribution", "", false, 0.0, 1.5};
  for (const Json& kind : kinds) {
    table.rows.push_back({text(kind, "specimen"), kind.at("specimens").dump(), kind.at("links").dump(),
                          fmt::format("{:.3f}", number(kind, "smallest_eigenvalue")),
                          fmt::format("{:.3f}", number(kind, "largest_eigenvalue")),
                          percent(number(kind, "deviation")),
                          percent(number(kind, "deviation_of_random_directions"))});
    report::Series series{text(kind, "specimen"), Kind::line, {}, {}};
    const Json& sectors = list_of(kind, "by_phi");
    const double width = 360.0 / static_cast<double>(sectors.size());
    for (const Json& sector : sectors)
      series.x.push_back((static_cast<double>(series.x.size()) + 0.5) * width),
          series.y.push_back(sector.get<double>());
    chart.series.push_back(std::move(series));
  }
  chart.caption =
      "Links of internal elements; 1 everywhere when all directions are alike. Fabric eigenvalues are then a "
      "third each.";
  return {"Orientation of the links", {std::move(table), std::move(chart)}};
}

/// Points with their intervals as vertical lines, one place along x an input.
report::Chart indices_chart(const std::string& quantity, const Json& inputs) {
  report::Chart chart;
  chart.title = "Sobol indices of " + quantity;
  chart.x = {"input", "", false, 0.5, static_cast<double>(inputs.size()) + 0.5};
  chart.y = {"share of the variance", "", false, {}, {}};
  int colour = 0;
  for (const auto& [key, words, shift] : {std::tuple("first", "alone (first order)", -0.1),
                                          std::tuple("total", "with its interactions (total)", 0.1)}) {
    report::Series points{words, Kind::points, {}, {}}, lines{std::string(words) + ", 95%", Kind::line, {}, {}};
    points.colour = lines.colour = colour++;
    lines.thin = true;
    double place = 0;
    for (const Json& input : inputs) {
      const double x = ++place + shift;
      points.x.push_back(x), points.y.push_back(number(input, key));
      for (const Json& end : list_of(input, std::string(key) + "_interval"))
        lines.x.push_back(x), lines.y.push_back(end.is_number() ? end.get<double>() : no_number);
      lines.x.push_back(x), lines.y.push_back(no_number);
    }
    chart.series.push_back(std::move(lines));
    chart.series.push_back(std::move(points));
  }
  double place = 0;
  for (const Json& input : inputs)
    chart.caption +=
        fmt::format("{}{:.0f}: {}", chart.caption.empty() ? "" : ", ", ++place, text(input, "parameter"));
  chart.caption += ".";
  return chart;
}

report::Section sensitivity_section(const Json& sensitivity) {
  report::Section section{"Sensitivity", {}};
  section.blocks.emplace_back(report::Text{
      "Which share of a quantity's variance over the ranges comes from which input: alone (first order), and "
      "with everything that it does together with others (total). In brackets the 95% interval. Estimates from "
      "few "
      "settings may leave the range from 0 to 1."});
  report::Table ranges{{"input", "from", "to", "spacing"}, {}};
  for (const Json& range : list_of(sensitivity, "ranges")) {
    const std::string key = text(range, "parameter");
    ranges.rows.push_back({label_of(key).words, value_words(key, range.at("from")),
                           value_words(key, range.at("to")), text(range, "spacing")});
  }
  section.blocks.emplace_back(std::move(ranges));
  report::Table table{{"quantity", "input", "alone", "total"}, {}};
  std::vector<report::Chart> charts;
  const auto cell = [](const Json& input, const std::string& key) {
    return fmt::format("{:.2f} [{}]", number(input, key),
                       interval_words(input.value(key + "_interval", Json()), 1, ""));
  };
  for (const auto& [name, entry] : object_of(sensitivity, "quantities").items()) {
    if (!is_main(name) && !name.ends_with("peak_strain")) continue;
    const std::string words = label_of_quantity(name).words;
    for (const Json& input : list_of(entry, "inputs"))
      table.rows.push_back({words, text(input, "parameter"), cell(input, "first"), cell(input, "total")});
    charts.push_back(indices_chart(words, list_of(entry, "inputs")));
  }
  section.blocks.emplace_back(std::move(table));
  for (report::Chart& chart : charts) section.blocks.emplace_back(std::move(chart));
  return section;
}

}  // namespace

Label label_of_quantity(const std::string& name) {
  if (name == "ft") return {"tensile strength", "MPa", 1e-6};
  if (name == "fc") return {"compressive strength", "MPa", 1e-6};
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return label_of(name);
  Label label = label_of(name.substr(dot + 1));
  label.words += fmt::format(" ({})", name.substr(0, dot));
  return label;
}

std::vector<report::Section> statistics_sections(const Json& result) {
  const Json& statistics = object_of(result, "statistics");
  std::vector<report::Section> sections;
  const auto add = [&](report::Section section) {
    if (!section.blocks.empty()) sections.push_back(std::move(section));
  };
  add(scatter_section(result));
  if (const Json& kinds = list_of(result, "orientation"); !kinds.empty()) add(orientation_section(kinds));
  add(effects_section(object_of(statistics, "quantities")));
  if (const Json& errors = list_of(statistics, "card_errors"); !errors.empty()) add(card_section(errors));
  if (const Json& fit = object_of(statistics, "eq1"); !fit.empty()) add(eq1_section(fit));
  if (const Json& sensitivity = object_of(statistics, "sensitivity"); !sensitivity.empty())
    add(sensitivity_section(sensitivity));
  return sections;
}

}  // namespace app
