// case.toml -> CalibrationCase. docs/cases.md is the reader's side of this file: keep them together.
#include <fmt/format.h>

#include <fnmatch.h>
#include <algorithm>
#include <cmath>

#include "calibrate/case_parts.h"
#include "libdem/core/sha256.h"

namespace calibrate {
namespace {

using dem::TomlTable;
namespace fs = std::filesystem;

/// "curves/*.csv" relative to the case's folder, sorted; a plain name stands for itself.
std::vector<fs::path> expand(const TomlTable& table, const std::string& key, const fs::path& base) {
  std::vector<fs::path> files;
  for (const std::string& text : table.texts(key)) {
    const fs::path pattern = base / text;
    std::error_code error;
    // "curve [1].csv" may be the name of a file.
    if (text.find_first_of("*?[") == std::string::npos || fs::exists(pattern, error)) {
      if (!fs::is_regular_file(pattern, error))
        table.fail(key, fmt::format("there is no file \"{}\"", text),
                   "name files that exist, relative to the case file");
      files.push_back(pattern);
      continue;
    }
    std::vector<fs::path> matched;
    const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (fnmatch(pattern.filename().c_str(), entry.path().filename().c_str(), 0) == 0 &&
          entry.is_regular_file(error))
        matched.push_back(pattern.parent_path() / entry.path().filename());
    if (matched.empty())
      table.fail(key, fmt::format("no file matches \"{}\"", text),
                 "name files that exist, relative to the case file; *, ? and [] stand in the file's name only");
    std::sort(matched.begin(), matched.end());
    files.insert(files.end(), matched.begin(), matched.end());
  }
  if (files.empty()) table.fail(key, "names no file", "list one or more CSV files");
  return files;
}

/// Keys of [tension] and [compression] that say something about their curves.
const std::vector<std::string>& curve_keys() {
  static const std::vector<std::string> keys{
      "strain",         "stress",          "strain_unit",      "stress_unit",  "sign",
      "strain_sign",    "only_rows",       "post_peak_strain", "gauge_length", "post_peak_gauge_length",
      "toe_correction", "may_end_at_peak", "fit_curve"};
  return keys;
}

lab::SignConvention read_sign(const TomlTable& table, const char* key) {
  return lab::parse_sign_convention(
      table.choice(key, {"compression_positive", "tension_positive", "negative_is_compression"}),
      table.where(key));
}

double read_gauge_length(const TomlTable& table, const char* key) {
  if (!table.has(key)) return 0;
  const double length = table.quantity(key, dem::Quantity::length);
  if (!(length > 0)) table.fail(key, fmt::format("is {:.4g} m", length), "it must be greater than 0");
  return length;
}

PressOptions read_press(const TomlTable& table, bool tension) {
  PressOptions press;
  press.ends = dem::end_condition(table.choice(
      "ends", tension ? std::vector<std::string>{"free", "fixed"} : dem::end_condition_names(), "free"));
  press.platen_friction = table.number("platen_friction", press.platen_friction);
  if (!(press.platen_friction >= 0 && press.platen_friction <= 2))
    table.fail("platen_friction", fmt::format("is {}", press.platen_friction), "allowed: 0 to 2");
  if (table.has("platen_friction") && press.ends != dem::EndCondition::rough)
    table.fail("platen_friction", "has no meaning here", "write ends = \"rough\" beside it, or leave it out");
  press.rate = table.number("rate", 0);
  if (!(press.rate >= 0 && press.rate <= 1))
    table.fail("rate", fmt::format("is {}", press.rate),
               "allowed: 0 (chosen) to 1, of the wave speed times the elastic strain");
  return press;
}

std::optional<lab::Series> read_curves(const TomlTable& table, lab::Loading loading, const fs::path& base,
                                       CalibrationCase& result) {
  if (!table.has("curves")) {
    for (const std::string& key : curve_keys())
      if (table.has(key))
        table.fail(key, "is about curves, and there are none",
                   "name them with curves = [\"curves/*.csv\"], or leave this key out");
    return std::nullopt;
  }
  lab::CurveSpec spec;
  spec.loading = loading;
  spec.files = expand(table, "curves", base);
  spec.strain_column = table.text("strain", "strain");
  spec.stress_column = table.text("stress", "stress");
  spec.strain_unit = table.text("strain_unit", "");
  spec.stress_unit = table.text("stress_unit", "");
  spec.post_peak_strain_column = table.text("post_peak_strain", "");
  spec.gauge_length = read_gauge_length(table, "gauge_length");
  spec.post_peak_gauge_length = read_gauge_length(table, "post_peak_gauge_length");
  if (spec.post_peak_gauge_length > 0 && spec.post_peak_strain_column.empty())
    table.fail("post_peak_gauge_length", "belongs to a column that is not named",
               "name it with post_peak_strain = \"...\", or leave this key out");
  spec.sign = table.has("sign")                  ? read_sign(table, "sign")
              : loading == lab::Loading::tension ? lab::SignConvention::tension_positive
                                                 : lab::SignConvention::compression_positive;
  if (table.has("strain_sign")) spec.strain_sign = read_sign(table, "strain_sign");
  if (const auto rows = table.optional_table("only_rows"))
    spec.only_rows = lab::RowFilter{rows->text("column"), rows->number("equals")};
  lab::CurveOptions options;
  options.toe.enabled = table.boolean("toe_correction", true);
  options.check.may_end_at_peak = table.boolean("may_end_at_peak", loading == lab::Loading::tension);
  lab::Series series = lab::read_series(spec, options);
  for (const fs::path& file : spec.files) result.inputs.push_back({"curve", file, dem::sha256_of_file(file)});
  for (const std::string& note : series.notes) result.notes.push_back(note);
  return series;
}

/// Where the slip softening stays unless the case says otherwise: with it both a C25 and a C40 have the strain
/// at the compression peak that is measured (docs/validation.md).
constexpr double default_slip_softening = 16;

void refuse_in_papers_law(const TomlTable& table, const dem::MaterialCard& card, const char* key) {
  if (card.link_law == dem::LinkLawKind::paper && table.has(key))
    table.fail(key, "has no meaning in the paper's law",
               "write link_law = \"moment_transfer\" in [fixed], or leave it out");
}

/// The law, and the numbers of its moments, which no test of [tension] and [compression] tells apart: they are
/// held.
void read_link_law(const TomlTable& fixed, dem::MaterialCard& card) {
  card.link_law = fixed.choice("link_law", {"paper", "moment_transfer"}, "paper") == "paper"
                      ? dem::LinkLawKind::paper
                      : dem::LinkLawKind::moment_transfer;
  refuse_in_papers_law(fixed, card, "slip_softening");
  for (const auto& [key, value] : {std::pair("rolling_stiffness", &dem::MaterialCard::rolling_stiffness),
                                   std::pair("rolling_limit", &dem::MaterialCard::rolling_limit),
                                   std::pair("twisting_stiffness", &dem::MaterialCard::twisting_stiffness),
                                   std::pair("twisting_limit", &dem::MaterialCard::twisting_limit)}) {
    refuse_in_papers_law(fixed, card, key);
    card.*value = fixed.number(key, card.*value);
    if (!(card.*value >= 0 && card.*value <= 10))
      fixed.fail(key, fmt::format("is {}", card.*value), "allowed: 0 to 10");
  }
}

void read_parameters(const TomlTable& root, CalibrationCase& result) {
  struct Slot {
    const char* name;
    Parameter* parameter;
    dem::Quantity kind;
  };
  result.tensile_strength = {3e6, 1e4, 1e9, true, false};
  result.cohesion = {10e6, 1e4, 1e10, true, false};
  result.softening = {5, 0.5, 100, true, false};
  result.slip_softening = {default_slip_softening, 0.5, 200, false, false};
  const Slot slots[] = {{"T", &result.tensile_strength, dem::Quantity::stress},
                        {"Co", &result.cohesion, dem::Quantity::stress},
                        {"zeta", &result.softening, dem::Quantity::ratio},
                        {"slip_softening", &result.slip_softening, dem::Quantity::ratio}};
  const auto within_bounds = [](const TomlTable& table, const Slot& slot) {
    const double value = table.quantity(slot.name, slot.kind);
    const bool stress = slot.kind == dem::Quantity::stress;
    const double scale = stress ? 1e6 : 1;
    const char* unit = stress ? " MPa" : "";
    if (!(value >= slot.parameter->low && value <= slot.parameter->high))
      table.fail(slot.name, fmt::format("is {:.4g}{}", value / scale, unit),
                 fmt::format("allowed: {:g} to {:g}{}", slot.parameter->low / scale,
                             slot.parameter->high / scale, unit));
    return value;
  };
  if (const auto fixed = root.optional_table("fixed")) {
    fixed->allow_only({"T", "Co", "zeta", "phi_i", "phi_c", "density", "link_law", "slip_softening",
                       "rolling_stiffness", "rolling_limit", "twisting_stiffness", "twisting_limit",
                       "unloading", "cohesion_during_softening", "broken_link_contact"});
    read_link_law(*fixed, result.card);
    for (const Slot& slot : slots)
      if (fixed->has(slot.name))
        slot.parameter->value = within_bounds(*fixed, slot), slot.parameter->free = false,
        slot.parameter->given = true;
    dem::MaterialCard& card = result.card;
    const auto friction = [&](const char* key, double fallback) {
      const double angle = fixed->quantity(key, dem::Quantity::angle, fallback);
      constexpr double degree = 0.017453292519943295;
      if (!(angle >= 0 && angle <= (89 + 1e-9) * degree))
        fixed->fail(key, fmt::format("is {:.4g} degrees", angle / degree), "allowed: 0 to 89 degrees");
      return angle;
    };
    card.internal_friction = friction("phi_i", card.internal_friction);
    card.contact_friction = friction("phi_c", card.contact_friction);
    card.density = fixed->quantity("density", dem::Quantity::density, card.density);
    if (!(card.density >= 100 && card.density <= 20000))
      fixed->fail("density", fmt::format("is {:.4g} kg/m3", card.density), "allowed: 100 to 20000 kg/m3");
    card.unloading = fixed->choice("unloading", {"secant", "elastic"}, "secant") == "elastic"
                         ? dem::SofteningUnloading::elastic
                         : dem::SofteningUnloading::secant;
    card.cohesion_during_softening =
        fixed->choice("cohesion_during_softening", {"constant", "proportional"}, "constant") == "proportional"
            ? dem::CohesionDuringSoftening::proportional
            : dem::CohesionDuringSoftening::constant;
    card.broken_link_contact =
        fixed->choice("broken_link_contact", {"initial_distance", "radii"}, "initial_distance") == "radii"
            ? dem::BrokenLinkContact::radii
            : dem::BrokenLinkContact::initial_distance;
  }
  if (const auto begin = root.optional_table("start")) {
    begin->allow_only({"T", "Co", "zeta", "slip_softening"});
    if (begin->has("slip_softening")) {
      refuse_in_papers_law(*begin, result.card, "slip_softening");
      result.slip_softening.free = !result.slip_softening.given;
    }
    for (const Slot& slot : slots)
      if (begin->has(slot.name)) {
        if (!slot.parameter->free)
          begin->fail(slot.name, "is fixed as well", "a parameter is either fixed or has a start");
        slot.parameter->value = within_bounds(*begin, slot), slot.parameter->given = true;
      }
  }
}

}  // namespace

const Target* CalibrationCase::target(Quantity quantity) const {
  const auto found =
      std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.quantity == quantity; });
  return found == targets.end() ? nullptr : &*found;
}

CalibrationCase read_case(const fs::path& file) {
  const TomlTable table = TomlTable::read(file);
  CalibrationCase result = case_of(table);
  result.inputs.insert(result.inputs.begin(), {"case", file, table.sha256()});
  return result;
}

CalibrationCase case_of(const TomlTable& root) {
  const fs::path file = root.file();
  root.allow_only({"name", "concrete", "specimen", "targets", "tension", "compression", "code", "fixed", "test",
                   "start", "damping", "notes"});
  CalibrationCase result;
  result.file = file;
  const fs::path base = file.parent_path();
  result.name = root.text("name", file.stem().string());
  result.concrete = root.text("concrete", "");
  result.damping = root.number("damping", 0.3);
  if (!(result.damping >= 0 && result.damping < 1))
    root.fail("damping", fmt::format("is {}", result.damping), "allowed: 0 to below 1");
  if (root.has("notes")) result.notes = root.texts("notes");
  read_parameters(root, result);

  const auto targets = root.optional_table("targets");
  if (targets) read_targets(*targets, result);
  std::vector<std::string> press_keys{"curves", "ends", "platen_friction", "rate"};
  press_keys.insert(press_keys.end(), curve_keys().begin(), curve_keys().end());
  // Compression first: where both have curves, E is the compression test's, as EN 12390-13 has it.
  for (const bool tension : {false, true}) {
    const auto table = root.optional_table(tension ? "tension" : "compression");
    if (!table) continue;
    table->allow_only(press_keys);
    (tension ? result.tension : result.compression) = read_press(*table, tension);
    auto& series = tension ? result.tension_series : result.compression_series;
    series = read_curves(*table, tension ? lab::Loading::tension : lab::Loading::compression, base, result);
    const bool with_curve = table->boolean("fit_curve", false);
    if (series) add_series_targets(result, *series, tension, with_curve);
  }
  if (const auto code = root.optional_table("code")) read_code(*code, result);
  default_poisson_ratio(result);
  if (targets) read_tolerances(*targets, result);
  std::stable_sort(result.targets.begin(), result.targets.end(),
                   [](const Target& a, const Target& b) { return a.quantity < b.quantity; });
  refuse_impossible_targets(result);
  if (const auto specimen = root.optional_table("specimen")) {
    specimen->allow_only({"shape", "size", "elements", "fit_seeds", "check_seeds", "size_ratio", "cut_from",
                          "fit_centres", "check_centres"});
    read_specimens(*specimen, result);
  } else {
    read_specimens(TomlTable::parse("shape = \"box\"", file.string()), result);
  }
  read_laboratory_tests(root, result);
  root.finish();
  return result;
}

}  // namespace calibrate
