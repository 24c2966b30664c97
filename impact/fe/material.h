// The linear elastic material of the finite elements.
#pragma once
#include <Eigen/Core>
#include <string>

namespace fe {

struct Material {
  double young_modulus = 0;  ///< E [Pa]
  double poisson_ratio = 0;  ///< nu [-]
  double density = 0;        ///< rho [kg/m3]

  /// Throws InputError that begins with `where` and names the bound which is violated.
  void validate(const std::string& where) const;

  double first_lame() const;           ///< lambda [Pa]
  double shear_modulus() const;        ///< mu [Pa]
  double pressure_wave_speed() const;  ///< sqrt((lambda + 2 mu)/rho) [m/s]
  double shear_wave_speed() const;     ///< sqrt(mu/rho) [m/s]
  /// Stress = C strain, with doubled shear strains, in the order xx, yy, zz, xy, yz, zx [Pa].
  Eigen::Matrix<double, 6, 6> elasticity() const;
};

}  // namespace fe
