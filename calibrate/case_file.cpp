// case.toml -> CalibrationCase. docs/cases.md is the reader's side of this file: keep them together.
#include <fmt/format.h>

#include <fnmatch.h>
#include <algorithm>
#include <cmath>

#include "calibrate/calibration_case.h"
#include "calibrate/lab/code_formulas.h"
#include "libdem/config/toml_reader.h"
#include "libdem/core/error.h"
#include "specimens/representative.h"

namespace calibrate {
namespace {

using dem::InputError;
using dem::TomlTable;
namespace fs = std::filesystem;

struct TargetKey {
  Quantity quantity;
  dem::Quantity kind;
  double default_tolerance;
  double low, high;  ///< SI bounds of what can be meant
  const char* allowed;
};

const std::vector<TargetKey>& target_keys() {
  static const std::vector<TargetKey> keys{
      {Quantity::young_modulus, dem::Quantity::stress, 0.02, 1e8, 2e11, "0.1 GPa to 200 GPa"},
      {Quantity::poisson_ratio, dem::Quantity::ratio, 0.03, 0.02, 0.26,
       "0.02 to 0.26 (nu must stay below 1/alpha, about 0.27)"},
      {Quantity::tensile_strength, dem::Quantity::stress, 0.02, 1e4, 1e8, "0.01 MPa to 100 MPa"},
      {Quantity::tension_peak_strain, dem::Quantity::ratio, 0.20, 1e-6, 0.02, "0.001 permil to 20 permil"},
      {Quantity::fracture_energy, dem::Quantity::fracture_energy, 0.10, 0.1, 1e5, "0.1 N/m to 100 kN/m"},
      {Quantity::compressive_strength, dem::Quantity::stress, 0.02, 1e5, 1e9, "0.1 MPa to 1 GPa"},
      {Quantity::compression_peak_strain, dem::Quantity::ratio, 0.25, 1e-5, 0.05, "0.01 permil to 50 permil"},
      {Quantity::tension_curve, dem::Quantity::ratio, 0.10, 0, 1, ""},
      {Quantity::compression_curve, dem::Quantity::ratio, 0.10, 0, 1, ""}};
  return keys;
}

const TargetKey& key_of(Quantity quantity) {
  return *std::find_if(target_keys().begin(), target_keys().end(),
                       [&](const TargetKey& k) { return k.quantity == quantity; });
}

std::vector<std::string> target_names(bool with_curves) {
  std::vector<std::string> names;
  for (const TargetKey& key : target_keys())
    if (with_curves || !is_curve(key.quantity)) names.emplace_back(name_of(key.quantity));
  return names;
}

/// "curves/*.csv" relative to the case's folder, sorted; a plain name stands for itself.
std::vector<fs::path> expand(const TomlTable& table, const std::string& key, const fs::path& base) {
  std::vector<fs::path> files;
  for (const std::string& text : table.texts(key)) {
    const fs::path pattern = base / text;
    if (text.find_first_of("*?[") == std::string::npos) {
      files.push_back(pattern);
      continue;
    }
    std::vector<fs::path> matched;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(pattern.parent_path(), error))
      if (fnmatch(pattern.filename().c_str(), entry.path().filename().c_str(), 0) == 0)
        matched.push_back(entry.path());
    if (matched.empty())
      table.fail(key, fmt::format("no file matches \"{}\"", text),
                 "name files that exist, relative to the case file");
    std::sort(matched.begin(), matched.end());
    files.insert(files.end(), matched.begin(), matched.end());
  }
  if (files.empty()) table.fail(key, "names no file", "list one or more CSV files");
  return files;
}

PressOptions read_press(const TomlTable& table) {
  PressOptions press;
  press.ends = table.choice("ends", {"free", "fixed"}, "free") == "fixed" ? dem::EndCondition::fixed
                                                                          : dem::EndCondition::free;
  press.rate = table.number("rate", 0);
  if (!(press.rate >= 0 && press.rate <= 1))
    table.fail("rate", fmt::format("is {}", press.rate),
               "allowed: 0 (chosen) to 1, of the wave speed times the elastic strain");
  return press;
}

std::optional<lab::Series> read_curves(const TomlTable& table, lab::Loading loading, const fs::path& base,
                                       CalibrationCase& result) {
  if (!table.has("curves")) return std::nullopt;
  lab::CurveSpec spec;
  spec.loading = loading;
  spec.files = expand(table, "curves", base);
  spec.strain_column = table.text("strain", "strain");
  spec.stress_column = table.text("stress", "stress");
  spec.strain_unit = table.text("strain_unit", "");
  spec.stress_unit = table.text("stress_unit", "");
  spec.post_peak_strain_column = table.text("post_peak_strain", "");
  spec.gauge_length = table.quantity("gauge_length", dem::Quantity::length, 0);
  spec.post_peak_gauge_length = table.quantity("post_peak_gauge_length", dem::Quantity::length, 0);
  const std::string natural = loading == lab::Loading::tension ? "tension_positive" : "compression_positive";
  spec.sign = lab::parse_sign_convention(table.text("sign", natural), table.where("sign"));
  if (table.has("strain_sign"))
    spec.strain_sign = lab::parse_sign_convention(table.text("strain_sign"), table.where("strain_sign"));
  if (const auto rows = table.optional_table("only_rows"))
    spec.only_rows = lab::RowFilter{rows->text("column"), rows->number("equals")};
  lab::CurveOptions options;
  options.toe.enabled = table.boolean("toe_correction", true);
  options.check.may_end_at_peak = table.boolean("may_end_at_peak", loading == lab::Loading::tension);
  for (const fs::path& file : spec.files) result.inputs.push_back(file);
  lab::Series series = lab::read_series(spec, options);
  for (const std::string& note : series.notes) result.notes.push_back(note);
  return series;
}

/// Adds a target unless the case has it already; a given value that is far from a measured one is a
/// contradiction.
void add_target(CalibrationCase& result, Quantity quantity, double value, const std::string& source) {
  for (const Target& there : result.targets)
    if (there.quantity == quantity) {
      if (there.source == "given" && !is_curve(quantity) && std::abs(there.value - value) > 0.25 * value &&
          source.starts_with("mean of")) {
        const Display d = display(quantity);
        throw InputError(result.file.string() + fmt::format(": targets.{}", name_of(quantity)),
                         fmt::format("{:.4g} {} contradicts the curves, which give {:.4g}",
                                     there.value / d.scale, d.unit, value / d.scale),
                         "drop one of them, or check the units of the curves");
      }
      return;
    }
  result.targets.push_back({quantity, value, key_of(quantity).default_tolerance, source});
}

void add_series_targets(CalibrationCase& result, const std::optional<lab::Series>& series, bool tension,
                        bool with_curve) {
  if (!series) return;
  const std::string source =
      fmt::format("mean of {} curve{}", series->strength.count, series->strength.count == 1 ? "" : "s");
  const auto scatter = [](const lab::Measured& m) {
    return m.count > 1 && m.mean != 0 ? fmt::format(" (standard deviation {:.1f}%)", 100 * m.std / m.mean)
                                      : std::string();
  };
  add_target(result, Quantity::young_modulus, series->E.mean,
             source + scatter(series->E) + ", secant of EN 12390-13");
  add_target(result, tension ? Quantity::tensile_strength : Quantity::compressive_strength,
             series->strength.mean, source + scatter(series->strength));
  add_target(result, tension ? Quantity::tension_peak_strain : Quantity::compression_peak_strain,
             series->strain_at_peak.mean, source + scatter(series->strain_at_peak));
  if (with_curve)
    add_target(result, tension ? Quantity::tension_curve : Quantity::compression_curve, 0, source);
}

void read_code(const TomlTable& table, CalibrationCase& result) {
  table.allow_only({"code", "strength_class", "aggregate", "use"});
  const lab::Code code = lab::parse_code(table.text("code", "model_code_2010"), table.where("code"));
  const double fck = lab::parse_strength_class(table.text("strength_class"), table.where("strength_class"));
  const lab::Aggregate aggregate =
      lab::parse_aggregate(table.text("aggregate", "quartzite"), table.where("aggregate"));
  const lab::CodeConcrete concrete = lab::code_concrete(code, fck, aggregate);
  const std::vector<std::pair<Quantity, const lab::CodeTarget*>> offered{
      {Quantity::young_modulus, &concrete.E_secant},
      {Quantity::poisson_ratio, &concrete.nu},
      {Quantity::tensile_strength, &concrete.fctm},
      {Quantity::compressive_strength, &concrete.fcm},
      {Quantity::compression_peak_strain, &concrete.strain_at_peak},
      {Quantity::fracture_energy, &concrete.fracture_energy}};
  const std::vector<std::string> allowed{"E", "nu", "ft", "fc", "fc_strain", "Gf"};
  std::vector<std::string> use{"E", "nu", "ft", "fc"};
  if (table.has("use")) use = table.texts("use");
  for (const std::string& name : use) {
    const auto found =
        std::find_if(offered.begin(), offered.end(), [&](const auto& o) { return name == name_of(o.first); });
    if (found == offered.end())
      table.fail("use", fmt::format("\"{}\" is no target that a code gives", name),
                 fmt::format("allowed: {}", fmt::join(allowed, ", ")));
    if (found->second->source.empty())
      table.fail("use", fmt::format("{} does not give {}", lab::to_text(code), name),
                 "take another code, or give the value in [targets]");
    if (result.target(found->first) == nullptr) {
      add_target(result, found->first, found->second->value, found->second->source);
      result.notes.push_back(fmt::format("{} was not measured: it is a code's mean value ({})",
                                         display(found->first).words, found->second->source));
    }
  }
  if (!result.compression_series) result.compression_reference = concrete.compression;
  if (!result.tension_series) result.tension_reference = concrete.tension;
}

void read_targets(const TomlTable& table, CalibrationCase& result) {
  std::vector<std::string> known = target_names(false);
  known.emplace_back("tolerance");
  table.allow_only(known);
  for (const TargetKey& key : target_keys()) {
    const std::string name(name_of(key.quantity));
    if (is_curve(key.quantity) || !table.has(name)) continue;
    const double value = table.quantity(name, key.kind);
    if (!(value >= key.low && value <= key.high))
      table.fail(name, fmt::format("is {:.4g} in SI units", value), fmt::format("allowed: {}", key.allowed));
    result.targets.push_back({key.quantity, value, key.default_tolerance, "given"});
  }
}

void read_tolerances(const TomlTable& targets, CalibrationCase& result) {
  const auto table = targets.optional_table("tolerance");
  if (!table) return;
  std::vector<std::string> known = target_names(true);
  known.emplace_back("unseen");
  table->allow_only(known);
  const auto in_bounds = [&](const std::string& name) {
    const double value = table->quantity(name, dem::Quantity::ratio);
    if (!(value > 0 && value < 1))
      table->fail(name, fmt::format("is {}", value), "allowed: above 0, below 1 (relative: 0.02 is 2%)");
    return value;
  };
  for (Target& target : result.targets)
    if (table->has(name_of(target.quantity)))
      target.tolerance = in_bounds(std::string(name_of(target.quantity)));
  if (table->has("unseen")) result.check_tolerance = in_bounds("unseen");
}

void read_specimens(const TomlTable& table, CalibrationCase& result) {
  specimens::PackingOptions& packing = result.packing;
  const bool cylinder = table.choice("shape", {"box", "cylinder"}, "box") == "cylinder";
  packing.shape = cylinder ? specimens::Shape::cylinder : specimens::Shape::box;
  const std::vector<double> size = table.has("size") ? table.quantities("size", dem::Quantity::length)
                                                     : std::vector<double>{0.5, 0.25, 0.25};
  const std::size_t wanted = cylinder ? 2 : 3;
  if (table.has("size") && size.size() != wanted)
    table.fail("size", fmt::format("has {} lengths", size.size()),
               cylinder ? "a cylinder's size is diameter x length, as in \"98.6x300 mm\""
                        : "a box has three sides, as in \"0.5x0.25x0.25 m\"");
  if (cylinder && !table.has("size"))
    table.fail("size", "is missing", "a cylinder's size is diameter x length, as in \"98.6x300 mm\"");
  packing.size = cylinder ? dem::Vec3(size[0], size[0], size[1]) : dem::Vec3(size[0], size[1], size[2]);
  for (int axis = 0; axis < 3; ++axis)
    if (!(packing.size[axis] > 1e-3 && packing.size[axis] < 100))
      table.fail("size", fmt::format("has a side of {:.4g} m", packing.size[axis]), "allowed: 1 mm to 100 m");

  const auto seeds = [&](const char* key, std::vector<std::uint64_t> fallback) {
    if (!table.has(key)) return fallback;
    std::vector<std::uint64_t> list;
    for (const std::int64_t seed : table.integers(key)) {
      if (seed < 0) table.fail(key, fmt::format("{} is negative", seed), "a seed is 0 or more");
      list.push_back(static_cast<std::uint64_t>(seed));
    }
    return list;
  };
  if (table.has("cut_from")) {
    result.structure = table.file_path("cut_from");
    result.inputs.push_back(result.structure);
    const auto centres = [&](const char* key) {
      std::vector<dem::Vec3> list;
      for (const std::string& text : table.texts(key)) {
        const std::vector<double> c = dem::parse_quantities(text, dem::Quantity::length, table.where(key));
        if (c.size() != 3)
          table.fail(key, fmt::format("\"{}\" is no point", text), "write \"1.25,1.0,0.14 m\"");
        list.emplace_back(c[0], c[1], c[2]);
      }
      return list;
    };
    result.fit_centres = centres("fit_centres");
    if (table.has("check_centres")) result.check_centres = centres("check_centres");
    if (result.fit_centres.empty())
      table.fail("fit_centres", "is empty", "name at least one place to cut from");
    return;
  }
  packing.elements =
      static_cast<std::size_t>(table.has("elements") ? table.integer("elements", 1, 10'000'000) : 2700);
  if (const auto ratio = table.optional_number("size_ratio")) packing.grading.size_ratio = *ratio;
  packing.validate();
  specimens::require_enough_elements(packing.shape, packing.size, packing.elements);
  result.fit_seeds = seeds("fit_seeds", {1, 2, 3, 4});
  result.check_seeds = seeds("check_seeds", {101, 102, 103});
  if (result.fit_seeds.empty()) table.fail("fit_seeds", "is empty", "name at least one seed");
  std::vector<std::uint64_t> all = result.fit_seeds;
  all.insert(all.end(), result.check_seeds.begin(), result.check_seeds.end());
  std::sort(all.begin(), all.end());
  if (std::adjacent_find(all.begin(), all.end()) != all.end())
    table.fail("check_seeds", "a seed stands twice",
               "each specimen has its own seed, and unseen ones are not among fit_seeds");
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
  const Slot slots[] = {{"T", &result.tensile_strength, dem::Quantity::stress},
                        {"Co", &result.cohesion, dem::Quantity::stress},
                        {"zeta", &result.softening, dem::Quantity::ratio}};
  const auto positive = [](const TomlTable& table, const char* key, dem::Quantity kind) {
    const double value = table.quantity(key, kind);
    if (!(value > 0)) table.fail(key, fmt::format("is {:.4g}", value), "it must be positive");
    return value;
  };
  if (const auto fixed = root.optional_table("fixed")) {
    fixed->allow_only({"T", "Co", "zeta", "phi_i", "phi_c", "density", "unloading", "cohesion_during_softening",
                       "broken_link_contact"});
    for (const Slot& slot : slots)
      if (fixed->has(slot.name))
        slot.parameter->value = positive(*fixed, slot.name, slot.kind), slot.parameter->free = false,
        slot.parameter->given = true;
    dem::MaterialCard& card = result.card;
    card.internal_friction = fixed->quantity("phi_i", dem::Quantity::angle, card.internal_friction);
    card.contact_friction = fixed->quantity("phi_c", dem::Quantity::angle, card.contact_friction);
    card.density = fixed->quantity("density", dem::Quantity::density, card.density);
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
    begin->allow_only({"T", "Co", "zeta"});
    for (const Slot& slot : slots)
      if (begin->has(slot.name)) {
        if (!slot.parameter->free)
          begin->fail(slot.name, "is fixed as well", "a parameter is either fixed or has a start");
        slot.parameter->value = positive(*begin, slot.name, slot.kind), slot.parameter->given = true;
      }
  }
}

/// Targets that no concrete can meet together are refused before a minute is spent on them.
void refuse_contradictions(const CalibrationCase& result) {
  const auto value = [&](Quantity q) {
    return result.target(q) != nullptr ? result.target(q)->value : std::nan("");
  };
  const std::string file = result.file.string();
  const double E = value(Quantity::young_modulus), ft = value(Quantity::tensile_strength),
               fc = value(Quantity::compressive_strength);
  const auto refuse = [&](const char* keys, const std::string& wrong, const char* remedy) {
    throw InputError(file + ": targets " + keys, wrong, remedy);
  };
  if (ft >= fc)
    refuse("ft and fc",
           fmt::format("contradict each other: ft {:.4g} MPa is not below fc {:.4g} MPa", ft / 1e6, fc / 1e6),
           "check the units and which is which");
  const double ft_strain = value(Quantity::tension_peak_strain),
               fc_strain = value(Quantity::compression_peak_strain);
  if (ft_strain < 0.9 * ft / E)
    refuse("ft_strain, ft and E",
           fmt::format("contradict each other: the strain at the tension peak, {:.3g} permil, is below the "
                       "elastic ft/E = {:.3g} permil",
                       1e3 * ft_strain, 1e3 * ft / E),
           "check the units");
  if (fc_strain < 0.9 * fc / E)
    refuse("fc_strain, fc and E",
           fmt::format("contradict each other: the strain at the compression peak, {:.3g} permil, is below the "
                       "elastic fc/E = {:.3g} permil",
                       1e3 * fc_strain, 1e3 * fc / E),
           "check the units");
  const double strength_strain = fc / E;
  if (strength_strain > 0.05)
    refuse("fc and E", fmt::format("contradict each other: fc/E is a strain of {:.3g}", strength_strain),
           "check the units");
}

}  // namespace

const Target* CalibrationCase::target(Quantity quantity) const {
  const auto found =
      std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.quantity == quantity; });
  return found == targets.end() ? nullptr : &*found;
}

CalibrationCase read_case(const fs::path& file) {
  const TomlTable root = TomlTable::read(file);
  root.allow_only({"name", "concrete", "specimen", "targets", "tension", "compression", "code", "fixed",
                   "start", "damping", "notes"});
  CalibrationCase result;
  result.file = file;
  result.inputs.push_back(file);
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
  const std::vector<std::string> press_keys{"curves",
                                            "strain",
                                            "stress",
                                            "strain_unit",
                                            "stress_unit",
                                            "sign",
                                            "strain_sign",
                                            "only_rows",
                                            "post_peak_strain",
                                            "gauge_length",
                                            "post_peak_gauge_length",
                                            "toe_correction",
                                            "may_end_at_peak",
                                            "fit_curve",
                                            "ends",
                                            "rate"};
  for (const bool tension : {true, false}) {
    const auto table = root.optional_table(tension ? "tension" : "compression");
    if (!table) continue;
    table->allow_only(press_keys);
    (tension ? result.tension : result.compression) = read_press(*table);
    auto& series = tension ? result.tension_series : result.compression_series;
    series = read_curves(*table, tension ? lab::Loading::tension : lab::Loading::compression, base, result);
    const bool with_curve = table->boolean("fit_curve", false);
    if (with_curve && !series)
      table->fail("fit_curve", "is set, but there are no curves", "name them with curves = [...]");
    add_series_targets(result, series, tension, with_curve);
  }
  if (const auto code = root.optional_table("code")) read_code(*code, result);
  if (result.target(Quantity::poisson_ratio) == nullptr) {
    add_target(result, Quantity::poisson_ratio, 0.2, "EN 1992-1-1, 3.1.3(4)");
    result.notes.emplace_back(
        "nu was neither measured nor given: 0.2 as EN 1992-1-1, 3.1.3(4) has it for uncracked concrete");
  }
  if (targets) read_tolerances(*targets, result);
  std::stable_sort(result.targets.begin(), result.targets.end(),
                   [](const Target& a, const Target& b) { return a.quantity < b.quantity; });
  if (const auto specimen = root.optional_table("specimen")) {
    specimen->allow_only({"shape", "size", "elements", "fit_seeds", "check_seeds", "size_ratio", "cut_from",
                          "fit_centres", "check_centres"});
    read_specimens(*specimen, result);
  } else {
    read_specimens(TomlTable::parse("shape = \"box\"", file.string()), result);
  }
  root.finish();

  if (result.target(Quantity::young_modulus) == nullptr)
    throw InputError(file.string() + ": targets.E", "is missing",
                     "give E = \"30 GPa\", curves in [compression], or a [code]");
  if (result.target(Quantity::tensile_strength) == nullptr &&
      result.target(Quantity::compressive_strength) == nullptr)
    throw InputError(file.string() + ": targets", "name neither ft nor fc",
                     "give at least one strength, curves, or a [code]");
  refuse_contradictions(result);
  return result;
}

}  // namespace calibrate
