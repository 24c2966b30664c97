// Targets of a case: given, measured on curves, or what a code says about a strength class.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/case_parts.h"
#include "calibrate/lab/code_formulas.h"
#include "libdem/config/nearest_name.h"
#include "libdem/core/error.h"

namespace calibrate {
namespace {

using dem::InputError;
using dem::TomlTable;

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

}  // namespace

void add_series_targets(CalibrationCase& result, const lab::Series& series, bool tension, bool with_curve) {
  const std::string source =
      fmt::format("mean of {} curve{}", series.strength.count, series.strength.count == 1 ? "" : "s");
  const auto scatter = [](const lab::Measured& m) {
    return m.count > 1 && m.mean != 0 ? fmt::format(" (standard deviation {:.1f}%)", 100 * m.std / m.mean)
                                      : std::string();
  };
  if (const Target* other = result.target(Quantity::young_modulus);
      other != nullptr && other->source != "given" && std::abs(series.E.mean / other->value - 1) > 0.15)
    result.notes.push_back(
        fmt::format("the {} curves give E = {:.3g} GPa, {:+.0f}% off the {:.3g} GPa that is fitted ({})",
                    tension ? "tension" : "compression", series.E.mean / 1e9,
                    100 * (series.E.mean / other->value - 1), other->value / 1e9, other->source));
  add_target(result, Quantity::young_modulus, series.E.mean,
             source + scatter(series.E) + ", secant of EN 12390-13");
  add_target(result, tension ? Quantity::tensile_strength : Quantity::compressive_strength,
             series.strength.mean, source + scatter(series.strength));
  add_target(result, tension ? Quantity::tension_peak_strain : Quantity::compression_peak_strain,
             series.strain_at_peak.mean, source + scatter(series.strain_at_peak));
  if (with_curve)
    add_target(result, tension ? Quantity::tension_curve : Quantity::compression_curve, 0, source);
}

void read_code(const TomlTable& table, CalibrationCase& result) {
  table.allow_only({"code", "strength_class", "aggregate", "use"});
  const lab::Code code = lab::parse_code(
      table.choice("code", {"model_code_2010", "eurocode2_2004"}, "model_code_2010"), table.where("code"));
  if (!table.has("strength_class"))
    table.fail("strength_class", "is missing", "write it as in strength_class = \"C40/50\"");
  const double fck = lab::parse_strength_class(table.text("strength_class"), table.where("strength_class"));
  const lab::Aggregate aggregate = lab::parse_aggregate(
      table.choice("aggregate", {"basalt", "quartzite", "limestone", "sandstone"}, "quartzite"),
      table.where("aggregate"));
  const lab::CodeConcrete concrete = [&] {
    try {
      return lab::code_concrete(code, fck, aggregate);
    } catch (const InputError& error) {
      throw InputError(table.where("strength_class"), error.what(), "");
    }
  }();
  const std::vector<std::pair<Quantity, const lab::CodeTarget*>> offered{
      {Quantity::young_modulus, &concrete.E_secant},
      {Quantity::poisson_ratio, &concrete.nu},
      {Quantity::tensile_strength, &concrete.fctm},
      {Quantity::compressive_strength, &concrete.fcm},
      {Quantity::compression_peak_strain, &concrete.strain_at_peak},
      {Quantity::tension_peak_strain, &concrete.tension_strain_at_peak},
      {Quantity::fracture_energy, &concrete.fracture_energy}};
  const std::vector<std::string> allowed{"E", "nu", "ft", "ft_strain", "fc", "fc_strain", "Gf"};
  std::vector<std::string> use{"E", "nu", "ft", "fc"};
  if (table.has("use")) use = table.texts("use");
  for (const std::string& name : use) {
    const auto found =
        std::find_if(offered.begin(), offered.end(), [&](const auto& o) { return name == name_of(o.first); });
    if (found == offered.end())
      table.fail("use", fmt::format("\"{}\" is no target that a code gives", name),
                 dem::suggestion(name, allowed));
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
  for (const TargetKey& key : target_keys())
    if (const std::string name(name_of(key.quantity));
        table->has(name) && result.target(key.quantity) == nullptr)
      table->fail(name, "is the tolerance of a target that the case does not have",
                  is_curve(key.quantity) ? "give the test its curves and fit_curve = true, or leave this out"
                                         : "give the target, or leave this out");
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

void default_poisson_ratio(CalibrationCase& result) {
  if (result.target(Quantity::poisson_ratio) != nullptr) return;
  add_target(result, Quantity::poisson_ratio, 0.2, "EN 1992-1-1, 3.1.3(4)");
  result.notes.emplace_back(
      "nu was neither measured nor given: 0.2 as EN 1992-1-1, 3.1.3(4) has it for uncracked concrete");
}

void refuse_impossible_targets(const CalibrationCase& result) {
  if (result.target(Quantity::young_modulus) == nullptr)
    throw InputError(result.file.string() + ": targets.E", "is missing",
                     "give E = \"30 GPa\", curves in [compression], or a [code] whose use has \"E\"");
  if (result.target(Quantity::tensile_strength) == nullptr &&
      result.target(Quantity::compressive_strength) == nullptr)
    throw InputError(result.file.string() + ": targets", "name neither ft nor fc",
                     "give at least one strength, as in ft = \"3 MPa\", curves, or a [code]");
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

}  // namespace calibrate
