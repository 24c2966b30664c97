#include "libdem/law/cohesive_link.h"

#include <algorithm>
#include <cmath>

#include "libdem/material/micro_macro.h"

namespace dem {

LinkLaw make_link_law(const MaterialCard& card) {
  card.validate(card.name);
  const LinkStiffness stiffness =
      link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
  return {.normal_modulus = stiffness.normal_modulus,
          .shear_ratio = stiffness.shear_ratio,
          .tensile_strength = card.tensile_strength,
          .cohesion = card.cohesion,
          .softening = card.softening,
          .internal_slope = std::tan(card.internal_friction),
          .contact_slope = std::tan(card.contact_friction),
          .unloading = card.unloading,
          .cohesion_during_softening = card.cohesion_during_softening,
          .broken_link_contact = card.broken_link_contact,
          .transfers_moments = card.link_law == LinkLawKind::moment_transfer,
          .slip_softening = card.slip_softening,
          .moment = {card.rolling_stiffness, card.rolling_limit, card.twisting_stiffness, card.twisting_limit}};
}

namespace {
double remaining_strength(const LinkLaw& law, double max_strain) {
  if (max_strain <= law.yield_strain()) return law.tensile_strength;
  return std::max(
      0.0, law.tensile_strength - law.normal_modulus / law.softening * (max_strain - law.yield_strain()));
}
}  // namespace

double stored_normal_energy(const LinkLaw& law, double strain, double max_strain, double volume) {
  const double elastic = 0.5 * law.normal_modulus * strain * strain * volume;
  if (max_strain <= law.yield_strain()) return elastic;
  const double remaining = remaining_strength(law, max_strain);
  if (remaining <= 0) return strain < 0 ? elastic : 0;
  if (law.unloading == SofteningUnloading::elastic) {
    const double stress = remaining - law.normal_modulus * (max_strain - strain);
    return 0.5 * stress * stress / law.normal_modulus * volume;
  }
  return strain < 0 ? elastic : 0.5 * remaining / max_strain * strain * strain * volume;
}

double softening_energy(const LinkLaw& law, double max_strain, double volume) {
  const double yield = law.yield_strain();
  if (max_strain <= yield) return 0;
  const double reached = std::min(max_strain, law.breaking_strain()),
               remaining = remaining_strength(law, reached);
  const double work =
      0.5 * law.tensile_strength * yield + 0.5 * (law.tensile_strength + remaining) * (reached - yield);
  const double recoverable = law.unloading == SofteningUnloading::elastic
                                 ? 0.5 * remaining * remaining / law.normal_modulus
                                 : 0.5 * remaining * reached;
  return (work - recoverable) * volume;
}

}  // namespace dem
