#include "app/calibration_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/calibration_charts.h"
#include "app/curve_table.h"
#include "app/scene_of_frames.h"
#include "report/html.h"

namespace app {
namespace {

bool is_curve(const Json& target) {
  return text(target, "name") == "tension_curve" || text(target, "name") == "compression_curve";
}

std::string percent(double fraction, int digits = 2) { return with_unit(100 * fraction, "%", digits); }

/// With its sign, a true minus.
std::string signed_number(double value, int decimals) {
  return fmt::format("{}{:.{}f}", value < 0 ? "−" : "+", std::abs(value), decimals);
}

/// "zeta" as people write it.
std::string symbol(const std::string& key) {
  if (key == "zeta") return "ζ";
  if (key == "nu") return "ν";
  if (key == "slip_softening") return "ζs";
  return key;
}

/// "tensile strength 2.91 MPa (−16 %, allowed ± 3 %)"
std::string target_words(const Json& target) {
  const std::string allowed = percent(number(target, "tolerance"));
  if (is_curve(target))
    return fmt::format("{} {} of the peak off (allowed {})", text(target, "words"),
                       percent(number(target, "achieved")), allowed);
  return fmt::format(
      "{} {} ({}, allowed ± {})", text(target, "words"),
      with_unit(number(target, "achieved") / target.value("scale", 1.0), people_unit(text(target, "unit"))),
      report::signed_percent(number(target, "rel_error")), allowed);
}

report::Target row_of(const Json& target) {
  const double scale = target.value("scale", 1.0);
  report::Target row;
  row.name = capital(target.value("words", target.value("name", "target")));
  row.unit = people_unit(text(target, "unit"));
  row.target = number(target, "target") / scale;
  row.achieved = number(target, "achieved") / scale;
  row.relative_error = number(target, "rel_error");
  row.tolerance = number(target, "tolerance");
  row.met = target.value("met", false);
  row.source = text(target, "source");
  return row;
}

report::Targets targets(const Json& list) {
  report::Targets table;
  for (const Json& target : list) table.rows.push_back(row_of(target));
  return table;
}

/// The unseen specimens' means with the worst of them, judged by the wider of the check's and the target's
/// tolerance.
report::Targets unseen_targets(const Json& result) {
  report::Targets table;
  for (const Json& target : list_of(result, "unseen_targets")) {
    report::Target row = row_of(target);
    row.source.clear();
    row.tolerance = std::max(row.tolerance, number(result, "check_tolerance"));
    row.worst = row.relative_error;
    for (const Json& specimen : list_of(result, "specimens"))
      for (const Json& own : list_of(specimen, "targets"))
        if (!specimen.value("seen", true) && text(own, "name") == text(target, "name") &&
            std::abs(number(own, "rel_error")) > std::abs(*row.worst))
          row.worst = number(own, "rel_error");
    row.met = std::isfinite(*row.worst) && std::abs(*row.worst) <= row.tolerance;
    table.rows.push_back(std::move(row));
  }
  return table;
}

void add_verdict(report::Page& page, const Json& result) {
  std::vector<std::string> missed, undetermined;
  for (const Json& target : result["targets"])
    if (!target.value("met", false)) missed.push_back(target_words(target));
  for (const Json& parameter : list_of(result, "parameters"))
    if (!parameter.value("determined", true)) undetermined.push_back(symbol(text(parameter, "name")));
  const std::size_t count = result["targets"].size();
  page.verdict = missed.empty() && undetermined.empty() ? report::Verdict::met : report::Verdict::not_met;
  std::string& words = page.verdict_words;
  if (missed.empty()) {
    words = count == 1 ? "The target is met." : fmt::format("All {} targets are met.", count);
  } else {
    words = fmt::format("{} of {} targets missed: ", missed.size(), count);
    for (std::size_t k = 0; k < missed.size(); ++k) words += (k > 0 ? "; " : "") + missed[k];
    words += ".";
  }
  if (!undetermined.empty()) {
    std::string names;
    for (std::size_t k = 0; k < undetermined.size(); ++k) names += (k > 0 ? " and " : "") + undetermined[k];
    words += fmt::format(" The data do not determine {}.", names);
  }
  const report::Targets unseen = unseen_targets(result);
  if (unseen.rows.empty()) return;
  std::size_t worst = 0;
  std::string beyond;
  for (std::size_t k = 0; k < unseen.rows.size(); ++k) {
    const report::Target& row = unseen.rows[k];
    if (std::abs(*row.worst) > std::abs(*unseen.rows[worst].worst)) worst = k;
    if (!row.met)
      beyond += fmt::format("{}{} {} (allowed ± {})", beyond.empty() ? "" : "; ",
                            text(result["unseen_targets"][k], "words"), report::signed_percent(*row.worst),
                            percent(row.tolerance));
  }
  words +=
      beyond.empty()
          ? fmt::format(
                " On specimens that the fit never saw, all are within their tolerance too; the worst "
                "single error is {} ({}).",
                report::signed_percent(*unseen.rows[worst].worst),
                text(result["unseen_targets"][worst], "words"))
          : fmt::format(" On specimens that the fit never saw, single ones are out of tolerance: {}.", beyond);
}

std::string size_words(const Json& specimen) {
  const Json& size = list_of(specimen, "size");
  if (size.size() != 3) return "";
  const auto side = [&](std::size_t k) { return report::number_text(1e3 * size[k].get<double>()); };
  return text(specimen, "shape") == "cylinder" ? fmt::format("cylinder ⌀ {} × {} mm", side(0), side(2))
                                               : fmt::format("box {} × {} × {} mm", side(0), side(1), side(2));
}

/// Geometry, counts and cost: what a reader needs to judge the numbers.
report::KeyValues setting(const Json& result) {
  report::KeyValues table;
  const Json specimen = result.value("specimen", Json::object()), ends = result.value("ends", Json::object());
  std::size_t seen = 0, unseen = 0;
  double elements = 0;
  for (const Json& one : list_of(result, "specimens")) {
    ++(one.value("seen", true) ? seen : unseen);
    elements += number(one, "elements");
  }
  if (const std::string size = size_words(specimen); !size.empty())
    table.rows.emplace_back(
        "Specimens", fmt::format("{}, about {} elements each", size,
                                 report::number_text(
                                     elements / static_cast<double>(std::max<std::size_t>(1, seen + unseen)))));
  if (const std::string structure = text(specimen, "cut_from"); !structure.empty())
    table.rows.emplace_back("Cut out of", structure);
  table.rows.emplace_back("Fitted on, checked on",
                          fmt::format("{} specimen{}, {} unseen", seen, seen == 1 ? "" : "s", unseen));
  if (!ends.empty())
    table.rows.emplace_back(
        "Ends of the specimens",
        fmt::format("{} in tension, {} in compression", text(ends, "tension"), text(ends, "compression")));
  const Json laboratory = result.value("laboratory", Json::object());
  for (const auto& [test, lab] : laboratory.items())
    if (lab.value("specimens", 0) > 0 && lab.contains("peak_stress"))
      table.rows.emplace_back(
          fmt::format("Laboratory, {}", test),
          fmt::format("{} specimens: strength {} to {}, strain at the peak {} to {}", lab.value("specimens", 0),
                      report::number_text(1e-6 * number(lab["peak_stress"], "min")),
                      with_unit(1e-6 * number(lab["peak_stress"], "max"), "MPa"),
                      report::number_text(1e3 * number(lab["peak_strain"], "min"), 3),
                      with_unit(1e3 * number(lab["peak_strain"], "max"), "‰", 3)));
  table.rows.emplace_back(
      "Cost", fmt::format("{} virtual tests in {}", value_words("virtual_tests", result["virtual_tests"]),
                          with_unit(number(result, "wall_seconds"), "s", 3)));
  return table;
}

const Json* parameter_of(const Json& result, const std::string& name) {
  for (const Json& parameter : list_of(result, "parameters"))
    if (text(parameter, "name") == name) return &parameter;
  return nullptr;
}

/// The card with where each number comes from and how well it is known.
report::Table card_table(const Json& result) {
  report::Table table;
  table.columns = {"Parameter", "Value", "Uncertainty", "How it was found"};
  const Json& card = result["card"];
  const Json fit = result.value("elastic_fit", Json::object());
  const Json& errors = list_of(fit, "standard_error");
  for (const auto& [key, value] : card.items()) {
    std::string uncertainty = "–", remark = "held";
    if (key == "E" || key == "nu") {
      remark = "the target; Eq. 1 turns it into the links' stiffnesses";
    } else if (key == "alpha" || key == "beta" || key == "gamma") {
      const std::size_t place = key == "alpha" ? 0 : key == "beta" ? 1 : 2;
      if (errors.size() == 3 && errors[place].is_number())
        uncertainty = "± " + report::number_text(errors[place].get<double>(), 2);
      remark = "least squares over Ks/Kn; standard error";
    } else if (key == "T" || key == "zeta" || key == "Co" || key == "slip_softening") {
      if (const Json* parameter = parameter_of(result, key); parameter != nullptr) {
        const double u = number(*parameter, "relative_uncertainty");
        uncertainty = u < 0.5 ? "± " + percent(u) : "× or ÷ " + report::number_text(std::exp(u), 2);
        remark = text(*parameter, "remark").empty() ? "fitted" : "fitted, but " + text(*parameter, "remark");
      } else {
        remark = "held at this value by the case";
      }
    } else if (value.is_string()) {
      remark = "choice of the model";
    }
    table.rows.push_back({capital(label_of(key).words), value_words(key, value), uncertainty, remark});
  }
  return table;
}

/// How the targets answer to the parameters, as a table and one sentence a target.
void add_sensitivity(report::Section& section, const Json& result) {
  const Json& rows = list_of(result, "sensitivity");
  if (rows.empty() || !rows.front().contains("by")) return;
  report::Table table;
  table.columns = {"1 % more of"};
  for (const auto& [name, value] : rows.front()["by"].items()) table.columns.push_back(symbol(name));
  std::string sentences;
  for (const Json& row : rows) {
    const std::string words = text(row, "words");
    table.rows.push_back({row.value("curve", false) ? "changes the distance to the " + words + " by"
                                                    : "changes the " + words + " by"});
    std::vector<std::pair<double, std::string>> strong;
    std::string weak;
    for (const auto& [name, value] : row["by"].items()) {
      const double change = value.is_number() ? value.get<double>() : NAN;
      table.rows.back().push_back(signed_number(change, 2) + " %");
      if (std::abs(change) >= 0.05)
        strong.emplace_back(change, symbol(name));
      else
        weak += (weak.empty() ? "" : " and ") + symbol(name);
    }
    std::sort(strong.begin(), strong.end(),
              [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
    std::string sentence = row.value("curve", false) ? "The distance to the " + words : "The " + words;
    if (strong.empty()) sentence += " answers to none of the parameters";
    for (std::size_t k = 0; k < strong.size(); ++k)
      sentence += fmt::format("{} {} ({})",
                              k == 0   ? " answers to"
                              : k == 1 ? ", then to"
                                       : " and to",
                              strong[k].second, signed_number(strong[k].first, 2));
    if (!strong.empty() && !weak.empty()) sentence += "; " + weak + " hardly moves it";
    sentences += (sentences.empty() ? "" : " ") + sentence + ".";
  }
  section.blocks.emplace_back(report::Text{
      "What the targets say of the parameters, by virtual tests a little below and above the card. " +
      sentences});
  section.blocks.emplace_back(std::move(table));
}

report::Table specimens_table(const Json& result) {
  struct Shown {
    const char *test, *key, *title;
  };
  static constexpr Shown all[] = {{"", "E", "E [GPa]"},
                                  {"", "nu", "ν"},
                                  {"tension", "peak_stress", "ft [MPa]"},
                                  {"tension", "peak_strain", "at [‰]"},
                                  {"compression", "peak_stress", "fc [MPa]"},
                                  {"compression", "peak_strain", "at [‰]"}};
  const Json& list = list_of(result, "specimens");
  report::Table table;
  table.columns = {"Specimen", "Use", "Elements", "Links"};
  std::vector<Shown> shown;
  for (const Shown& column : all)
    if (*column.test == 0 || list.front().contains(column.test)) {
      shown.push_back(column);
      table.columns.emplace_back(column.title);
    }
  for (const Json& specimen : list) {
    table.rows.push_back({text(specimen, "label"), specimen.value("seen", true) ? "fitted" : "unseen",
                          value_words("elements", specimen["elements"]),
                          value_words("links", specimen["links"])});
    for (const Shown& column : shown) {
      const Json& from = *column.test == 0 ? specimen : specimen.value(column.test, Json::object());
      table.rows.back().push_back(report::number_text(label_of(column.key).factor * number(from, column.key)));
    }
  }
  return table;
}

report::Table stages_table(const Json& result) {
  report::Table table;
  table.columns = {"Stage", "Fitted", "Evaluations", "Worst misfit / tolerance"};
  for (const Json& stage : list_of(result, "stages")) {
    std::string fitted;
    for (const Json& name : list_of(stage, "fitted"))
      fitted += (fitted.empty() ? "" : ", ") + symbol(name.get<std::string>());
    const bool ran = stage.value("evaluations", 0) > 0;
    table.rows.push_back({text(stage, "name"), fitted.empty() ? "nothing to fit" : fitted,
                          value_words("evaluations", stage["evaluations"]),
                          ran ? report::number_text(number(stage, "worst"), 3) : "–"});
  }
  return table;
}

/// As people read it: result.json and the card name units in ASCII.
std::string for_people(std::string words) {
  for (auto at = words.find(" permil"); at != std::string::npos; at = words.find(" permil", at))
    words.replace(at, 7, " ‰");
  for (auto at = words.find("(-"); at != std::string::npos; at = words.find("(-", at))
    words.replace(at, 2, "(−");
  return capital(words);
}

/// What was done to the laboratory's curves before they were used.
Json preparation_of(const Json& result) {
  Json all = Json::array();
  const Json laboratory = result.value("laboratory", Json::object());
  for (const auto& [test, lab] : laboratory.items())
    for (const Json& note : list_of(lab, "preparation"))
      if (note.is_string()) all.push_back("in " + note.get<std::string>());
  return all;
}

std::optional<report::Section> remarks(const char* title, const Json& list) {
  report::List shown;
  for (const Json& item : list)
    if (item.is_string()) shown.items.push_back(for_people(item.get<std::string>()));
  if (shown.items.empty()) return std::nullopt;
  return report::Section{title, {std::move(shown)}};
}

}  // namespace

report::Page calibration_page(const Json& result, const std::filesystem::path& folder) {
  report::Page page;
  page.title = "Calibration: " + text(result, "name");
  page.subtitle = text(result, "concrete");
  add_verdict(page, result);
  page.sections.push_back({"Targets", {targets(result["targets"])}});
  if (!list_of(result, "unseen_targets").empty())
    page.sections.push_back(
        {"On specimens that the fit never saw",
         {unseen_targets(result),
          report::Text{
              "The mean of the unseen specimens against the same targets. The result goes by the worst "
              "single specimen and the wider of the check's and the target's tolerance."}}});
  if (auto warnings = remarks("Warnings", list_of(result, "warnings"))) page.sections.push_back(*warnings);

  const std::vector<TestCurve> curves = read_test_curves(folder / "curves.csv");
  report::Section drawn{"Virtual and laboratory tests", {}};
  for (const char* test : {"compression", "tension"})
    if (report::Chart chart = test_chart(result, curves, test); !chart.series.empty())
      drawn.blocks.emplace_back(std::move(chart));
  drawn.blocks.emplace_back(setting(result));
  page.sections.push_back(std::move(drawn));

  report::Section space{"The first specimen in space", {}};
  for (const auto& [test, words] : {std::pair("compression", "Compression"), std::pair("tension", "Tension")})
    if (auto scene = scene_of_frames(folder / "frames" / test, words)) {
      scene->caption = "Tested with the finished card to well past the peak, farther than the fit goes.";
      space.blocks.emplace_back(std::move(*scene));
    }
  if (!space.blocks.empty()) page.sections.push_back(std::move(space));
  page.sections.push_back({"Material card", {card_table(result)}});
  report::Section data{"What the data determine", {}};
  add_sensitivity(data, result);
  if (!data.blocks.empty()) page.sections.push_back(std::move(data));
  report::Section elastic{"Elastic constants", {}};
  for (report::Chart& chart : elastic_charts(result)) elastic.blocks.emplace_back(std::move(chart));
  if (!elastic.blocks.empty()) page.sections.push_back(std::move(elastic));
  report::Section course{"Course of the fit", {}};
  if (!list_of(result, "stages").empty()) course.blocks.emplace_back(stages_table(result));
  for (report::Chart& chart : progress_charts(result)) course.blocks.emplace_back(std::move(chart));
  if (!course.blocks.empty()) page.sections.push_back(std::move(course));
  if (!list_of(result, "specimens").empty()) page.sections.push_back({"Specimens", {specimens_table(result)}});
  if (auto done = remarks("Preparation of the laboratory curves", preparation_of(result)))
    page.sections.push_back(*done);
  if (auto notes = remarks("Notes", list_of(result, "notes"))) page.sections.push_back(*notes);
  for (const Json& specimen : list_of(result, "specimens"))
    page.provenance.emplace_back("specimen " + text(specimen, "label") + ", SHA-256", text(specimen, "sha256"));
  return page;
}

}  // namespace app
