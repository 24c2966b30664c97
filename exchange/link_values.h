// Stiffness and strength of a single link, as forces: what codes want that know nothing of Eq. 1.
#pragma once
#include "libdem/law/cohesive_link.h"
#include "specimens/specimen.h"

namespace exchange {

struct LinkValues {
  double area = 0;                ///< S_int = pi min(Ra, Rb)^2 [m2]
  double normal_stiffness = 0;    ///< Kn = C S_int / D_init [N/m]
  double shear_stiffness = 0;     ///< Ks [N/m]
  double tensile_force = 0;       ///< T S_int [N]
  double shear_force = 0;         ///< Co S_int, without friction [N]
  double rolling_stiffness = 0;   ///< k_r Kn R^2 [N m/rad], R = min(Ra, Rb); 0 in the paper's law
  double twisting_stiffness = 0;  ///< k_t Kn R^2 [N m/rad]
};

/// Of a link between elements of which the smaller has this radius [m], `initial_distance` [m] apart.
LinkValues link_values(const dem::LinkLaw& law, double smaller_radius, double initial_distance);
LinkValues link_values(const dem::LinkLaw& law, const specimens::Specimen& specimen,
                       const specimens::Link& link);

}  // namespace exchange
