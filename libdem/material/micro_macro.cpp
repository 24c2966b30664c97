#include "libdem/material/micro_macro.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "libdem/core/error.h"

namespace dem {
namespace {

void require_positive(const char* where, const char* key, double value) {
  if (!(std::isfinite(value) && value > 0))
    throw InputError(fmt::format("{}: {}", where, key), fmt::format("{} is not a positive number", value),
                     fmt::format("{} must be finite and > 0", key));
}

void require_constants(const char* where, double alpha, double beta, double gamma) {
  require_positive(where, "alpha", alpha);
  require_positive(where, "beta", beta);
  require_positive(where, "gamma", gamma);
}

}  // namespace

LinkStiffness link_stiffness(double young_modulus, double poisson_ratio, double alpha, double beta,
                             double gamma) {
  constexpr const char* where = "micro-macro relation";
  require_positive(where, "E", young_modulus);
  require_constants(where, alpha, beta, gamma);
  // Written so that a NaN is refused too.
  if (!(poisson_ratio > -1 && poisson_ratio < 1 / alpha && poisson_ratio * alpha < 1))
    throw InputError(fmt::format("{}: nu", where),
                     fmt::format("{} would give links a shear stiffness that is not positive", poisson_ratio),
                     fmt::format("nu must stay below 1/alpha = {:.4g}", 1 / alpha));
  LinkStiffness link;
  link.normal_modulus =
      young_modulus * (1 + alpha) / (beta * (1 + poisson_ratio) + gamma * (1 - alpha * poisson_ratio));
  link.shear_ratio = (1 - alpha * poisson_ratio) / (1 + poisson_ratio);
  return link;
}

MacroElasticity macro_elasticity(const LinkStiffness& link, double alpha, double beta, double gamma) {
  constexpr const char* where = "micro-macro relation";
  require_positive(where, "Kn D_init / S_int", link.normal_modulus);
  require_positive(where, "Ks/Kn", link.shear_ratio);
  require_constants(where, alpha, beta, gamma);
  const double ratio = link.shear_ratio;
  return {link.normal_modulus * (beta + gamma * ratio) / (alpha + ratio), (1 - ratio) / (alpha + ratio)};
}

}  // namespace dem
