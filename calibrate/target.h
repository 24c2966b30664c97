// What a fit aims at, and how near it came.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace calibrate {

enum class Quantity {
  young_modulus,            ///< E [Pa]
  poisson_ratio,            ///< nu [-]
  tensile_strength,         ///< ft [Pa]
  tension_peak_strain,      ///< [-]
  fracture_energy,          ///< Gf, work after the tension peak per area [J/m2]
  compressive_strength,     ///< fc [Pa]
  compression_peak_strain,  ///< [-]
  tension_curve,            ///< root mean square difference over the peak stress [-]
  compression_curve,        ///< the same
  laboratory,               ///< a quantity that another laboratory test measures, see Target
};

/// "E", "nu", "ft", "ft_strain", "Gf", "fc", "fc_strain", "tension_curve", "compression_curve".
std::string_view name_of(Quantity quantity);
/// In words, with the unit that people read: {"tensile strength", "MPa", 1e6}.
struct Display {
  std::string_view words, unit;
  double scale;
};
Display display(Quantity quantity);
bool is_curve(Quantity quantity);
bool needs_tension(Quantity quantity);
bool needs_compression(Quantity quantity);

/// What another laboratory test measures.
struct LaboratoryQuantity {
  std::size_t test = 0;      ///< its place in the case
  std::string name;          ///< "splitting.splitting_strength"
  std::size_t quantity = 0;  ///< its place among the test's quantities
  std::string words, unit;   ///< see Display
  double scale = 1;
};

/// One target. A curve's value is 0 and its tolerance bounds the root mean square difference over the peak
/// stress.
struct Target {
  Quantity quantity;
  double value = 0;      ///< SI
  double tolerance = 0;  ///< relative
  std::string source;  ///< where the number comes from: "given", "mean of 5 curves", "fib Model Code 2010, ..."
  LaboratoryQuantity laboratory{};  ///< of Quantity::laboratory
};
std::string_view name_of(const Target& target);
Display display(const Target& target);

struct TargetResult {
  Target target;
  double achieved = 0;
  /// (achieved - target)/target; for a curve the root mean square difference over the peak stress.
  double relative_error() const;
  bool met() const;
};

/// How far a result is from its target, in the measure that the fits minimise: ln(achieved/target), or the
/// curve's difference itself. Nearly linear in the logarithms of the parameters.
double misfit(const TargetResult& result);

}  // namespace calibrate
