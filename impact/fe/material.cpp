#include "impact/fe/material.h"

#include <fmt/format.h>

#include <cmath>

#include "libdem/core/error.h"

namespace fe {

void Material::validate(const std::string& where) const {
  if (!(young_modulus > 0) || !std::isfinite(young_modulus))
    throw dem::InputError(where, fmt::format("Young's modulus is {:g} Pa", young_modulus),
                          "it must be above 0");
  if (!(poisson_ratio > -1 && poisson_ratio < 0.5))
    throw dem::InputError(where, fmt::format("Poisson's ratio is {:g}", poisson_ratio),
                          "it must lie between -1 and 0.5, both excluded");
  if (!(density > 0) || !std::isfinite(density))
    throw dem::InputError(where, fmt::format("the density is {:g} kg/m3", density), "it must be above 0");
}

double Material::first_lame() const {
  return young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
}
double Material::shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
double Material::pressure_wave_speed() const {
  return std::sqrt((first_lame() + 2 * shear_modulus()) / density);
}
double Material::shear_wave_speed() const { return std::sqrt(shear_modulus() / density); }

Eigen::Matrix<double, 6, 6> Material::elasticity() const {
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(first_lame());
  for (int i = 0; i < 3; ++i) {
    c(i, i) += 2 * shear_modulus();
    c(i + 3, i + 3) = shear_modulus();
  }
  return c;
}

}  // namespace fe
