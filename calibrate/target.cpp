#include "calibrate/target.h"

#include <algorithm>
#include <cmath>

namespace calibrate {

std::string_view name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::young_modulus:
      return "E";
    case Quantity::poisson_ratio:
      return "nu";
    case Quantity::tensile_strength:
      return "ft";
    case Quantity::tension_peak_strain:
      return "ft_strain";
    case Quantity::fracture_energy:
      return "Gf";
    case Quantity::compressive_strength:
      return "fc";
    case Quantity::compression_peak_strain:
      return "fc_strain";
    case Quantity::tension_curve:
      return "tension_curve";
    case Quantity::compression_curve:
      return "compression_curve";
    case Quantity::laboratory:
      return "laboratory";
  }
  return "";
}

Display display(Quantity quantity) {
  switch (quantity) {
    case Quantity::young_modulus:
      return {"Young's modulus", "GPa", 1e9};
    case Quantity::poisson_ratio:
      return {"Poisson's ratio", "-", 1};
    case Quantity::tensile_strength:
      return {"tensile strength", "MPa", 1e6};
    case Quantity::tension_peak_strain:
      return {"strain at the tension peak", "permil", 1e-3};
    case Quantity::fracture_energy:
      return {"fracture energy", "J/m2", 1};
    case Quantity::compressive_strength:
      return {"compressive strength", "MPa", 1e6};
    case Quantity::compression_peak_strain:
      return {"strain at the compression peak", "permil", 1e-3};
    case Quantity::tension_curve:
      return {"tension curve", "% of the peak", 1e-2};
    case Quantity::compression_curve:
      return {"compression curve", "% of the peak", 1e-2};
    case Quantity::laboratory:
      return {"laboratory test", "-", 1};
  }
  return {"", "", 1};
}

std::string_view name_of(const Target& target) {
  return target.quantity == Quantity::laboratory ? target.laboratory.name : name_of(target.quantity);
}

Display display(const Target& target) {
  return target.quantity == Quantity::laboratory
             ? Display{target.laboratory.words, target.laboratory.unit, target.laboratory.scale}
             : display(target.quantity);
}

bool is_curve(Quantity quantity) {
  return quantity == Quantity::tension_curve || quantity == Quantity::compression_curve;
}
bool needs_tension(Quantity quantity) {
  return quantity == Quantity::tensile_strength || quantity == Quantity::tension_peak_strain ||
         quantity == Quantity::fracture_energy || quantity == Quantity::tension_curve;
}
bool needs_compression(Quantity quantity) {
  return quantity == Quantity::compressive_strength || quantity == Quantity::compression_peak_strain ||
         quantity == Quantity::compression_curve;
}

double TargetResult::relative_error() const {
  return is_curve(target.quantity) ? achieved : (achieved - target.value) / target.value;
}

bool TargetResult::met() const {
  return std::isfinite(achieved) && std::abs(relative_error()) <= target.tolerance;
}

double misfit(const TargetResult& result) {
  if (is_curve(result.target.quantity)) return result.achieved;
  return std::log(std::max(result.achieved / result.target.value, 1e-6));
}

}  // namespace calibrate
