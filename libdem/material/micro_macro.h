// Eq. 1 of the paper: from the concrete's Young's modulus and Poisson's ratio to the stiffness of a link, and
// back.
#pragma once

namespace dem {

/// Elastic stiffness of a link, freed from its size: Kn = normal_modulus * S_int / D_init, Ks = shear_ratio *
/// Kn, with S_int = pi min(Ra, Rb)^2.
struct LinkStiffness {
  double normal_modulus = 0;  ///< Kn D_init / S_int [Pa]
  double shear_ratio = 0;     ///< Ks / Kn [-]
};

/// Elasticity of the assembly as a continuum.
struct MacroElasticity {
  double young_modulus = 0;  ///< E [Pa]
  double poisson_ratio = 0;  ///< nu [-]
};

/// Eq. 1, right-hand form. `young_modulus` in Pa. Throws InputError if nu >= 1/alpha (Ks would be negative or
/// zero), if nu <= -1, or if a value is not finite or not positive where it must be.
LinkStiffness link_stiffness(double young_modulus, double poisson_ratio, double alpha, double beta,
                             double gamma);

/// Eq. 1, left-hand form: the inverse of link_stiffness. Throws InputError if a value is not finite or not
/// positive.
MacroElasticity macro_elasticity(const LinkStiffness& link, double alpha, double beta, double gamma);

}  // namespace dem
