#include "exchange/link_values.h"

#include <algorithm>
#include <numbers>

namespace exchange {

LinkValues link_values(const dem::LinkLaw& law, double smaller_radius, double initial_distance) {
  LinkValues values;
  values.area = std::numbers::pi * smaller_radius * smaller_radius;
  values.normal_stiffness = law.normal_modulus * values.area / initial_distance;
  values.shear_stiffness = law.shear_ratio * values.normal_stiffness;
  values.tensile_force = law.tensile_strength * values.area;
  values.shear_force = law.cohesion * values.area;
  if (law.transfers_moments) {
    const double unit = values.normal_stiffness * smaller_radius * smaller_radius;
    values.rolling_stiffness = law.moment.rolling_stiffness * unit;
    values.twisting_stiffness = law.moment.twisting_stiffness * unit;
  }
  return values;
}

LinkValues link_values(const dem::LinkLaw& law, const specimens::Specimen& specimen,
                       const specimens::Link& link) {
  return link_values(law,
                     std::min(specimen.radii[static_cast<std::size_t>(link.a)],
                              specimen.radii[static_cast<std::size_t>(link.b)]),
                     link.initial_distance);
}

}  // namespace exchange
