#include "impact/outcome/penetration_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace impact {
namespace {

void require_positive(double value, const char* what, const std::string& where) {
  if (!(value > 0 && std::isfinite(value)))
    throw dem::InputError(where, fmt::format("the {} is {}", what, value), "it must be positive and finite");
}

void require_common(const MissileCase& missile, const std::string& where) {
  require_positive(missile.mass, "missile's mass", where);
  require_positive(missile.velocity, "missile's velocity", where);
  require_positive(missile.diameter, "missile's diameter", where);
  require_positive(missile.compressive_strength, "concrete's compressive strength", where);
}

}  // namespace

bool applies(const std::vector<ValidityRange>& ranges) {
  return std::all_of(ranges.begin(), ranges.end(), [](const ValidityRange& range) { return range.holds(); });
}

NdrcResult modified_ndrc(const MissileCase& missile, const std::string& where) {
  require_common(missile, where);
  require_positive(missile.nose_factor, "nose factor", where);
  const double d = missile.diameter;
  NdrcResult result;
  result.impact_function = 3.8e-5 * missile.nose_factor * missile.mass /
                           (d * std::sqrt(missile.compressive_strength)) * std::pow(missile.velocity / d, 1.8);
  const double g = result.impact_function, x = g <= 1 ? 2 * std::sqrt(g) : g + 1;
  result.penetration_depth = x * d;
  const double e = x <= 1.35 ? 3.19 * x - 0.718 * x * x : 1.32 + 1.24 * x;
  const double h = x <= 0.65 ? 7.91 * x - 5.06 * x * x : 2.12 + 1.36 * x;
  result.perforation_thickness = e * d;
  result.scabbing_thickness = h * d;
  const std::string source = "Kennedy 1976, DOE-STD-3014 appendix C";
  result.perforation_ranges = {{"x/d", 0, 13.5, x, source}};
  result.scabbing_ranges = {{"x/d", 0, 11.75, x, source}};
  return result;
}

CeaEdfResult cea_edf(const MissileCase& missile, const std::string& where) {
  require_common(missile, where);
  require_positive(missile.density, "concrete's density", where);
  require_positive(missile.thickness, "wall's thickness", where);
  const double d = missile.diameter, e = missile.thickness, m = missile.mass, v = missile.velocity;
  const double strength = 1.3 * std::pow(missile.density, 1.0 / 6) * std::sqrt(missile.compressive_strength);
  CeaEdfResult result;
  result.perforation_velocity = strength * std::pow(d * e * e / m, 2.0 / 3);
  result.perforation_thickness = std::sqrt(m / d * std::pow(v / strength, 1.5));
  const std::string source = "as usually quoted with Berriaud et al. 1978";
  result.ranges = {{"V [m/s]", 20, 200, v, source},
                   {"e/d", 0.35, 4.17, e / d, source},
                   {"f_c [MPa]", 23, 46, missile.compressive_strength / 1e6, source},
                   {"M [kg]", 20, 300, m, source}};
  return result;
}

}  // namespace impact
