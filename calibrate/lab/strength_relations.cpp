#include "calibrate/lab/strength_relations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace lab {
namespace {

constexpr double fc_unit = 10e6;  // fco of both model codes [Pa]

/// A power law of the rate up to `knee`, the cube root above it, times a factor that joins the two.
double two_branches(double rate, double reference, double exponent, double knee, double factor) {
  const double ratio = rate / reference;
  return rate <= knee ? std::pow(ratio, exponent) : factor * std::cbrt(ratio);
}

void require_positive(double strain_rate, double fc) {
  if (!(strain_rate > 0))
    throw dem::InputError("strain rate", fmt::format("{} is out of range", strain_rate), "allowed: positive");
  if (!(fc > 0)) throw dem::InputError("fc", fmt::format("{} is out of range", fc), "allowed: positive");
}

}  // namespace

double rate_factor_in_tension(RateRule rule, double strain_rate, double fc) {
  require_positive(strain_rate, fc);
  double factor = 0;
  switch (rule) {
    case RateRule::model_code_2010:
      factor = two_branches(strain_rate, 1e-6, 0.018, 10, 0.0062);
      break;
    case RateRule::model_code_1990: {
      const double delta = 1 / (10 + 6 * fc / fc_unit);
      factor = two_branches(strain_rate, 3e-6, 1.016 * delta, 30, std::pow(10, 7.112 * delta - 2.33));
      break;
    }
    case RateRule::malvar_ross_1998: {
      const double delta = 1 / (1 + 8 * fc / fc_unit);
      factor = two_branches(strain_rate, 1e-6, delta, 1, std::pow(10, 6 * delta - 2));
      break;
    }
  }
  return std::max(factor, 1.0);
}

double rate_factor_in_compression(RateRule rule, double strain_rate, double fc) {
  require_positive(strain_rate, fc);
  double factor = 0;
  if (rule == RateRule::model_code_2010) {
    factor = two_branches(strain_rate, 30e-6, 0.014, 30, 0.012);
  } else {
    const double alpha = 1 / (5 + 9 * fc / fc_unit);
    factor = two_branches(strain_rate, 30e-6, 1.026 * alpha, 30, std::pow(10, 6.156 * alpha - 2));
  }
  return std::max(factor, 1.0);
}

double bending_over_tension_model_code(double depth) {
  const double a = 0.06 * std::pow(1e3 * depth, 0.7);
  return (1 + a) / a;
}

double bending_over_tension_eurocode(double depth) { return std::max(1.6 - depth, 1.0); }

double confined_strength(ConfinementRule rule, double p) {
  switch (rule) {
    case ConfinementRule::richart_1928:
      return 1 + 4.1 * p;
    case ConfinementRule::xie_1995:
      return std::sqrt(1 + 21.2 * p);
    case ConfinementRule::imran_1996:
      break;
  }
  return p + std::sqrt(1 + 10.571 * p);
}

double residual_strain_karsan_jirsa(double x) {
  return x < 2 ? 0.145 * x * x + 0.13 * x : 0.707 * (x - 2) + 0.834;
}

}  // namespace lab
