// How one strength of a concrete follows from another, as codes and test series give it: what predictions are
// held against. data/reference/laboratory.md says how sure each of them is.
#pragma once

namespace lab {

/// Strength at a strain rate over the static one [-], in tension or compression. fc in Pa: the mean (Model Code
/// 2010 does not use it) or cylinder strength. Throws dem::InputError unless rate and fc are positive.
enum class RateRule {
  model_code_2010,   ///< fib Model Code 2010, 5.1.11.2: up to 300/s
  model_code_1990,   ///< CEB-FIP Model Code 1990, 2.1.6.3
  malvar_ross_1998,  ///< tension only: ACI Materials Journal 95(6), 735-739; compression as Model Code 1990
};
double rate_factor_in_tension(RateRule rule, double strain_rate, double fc);
double rate_factor_in_compression(RateRule rule, double strain_rate, double fc);

/// Bending over direct tensile strength of a beam of this depth [m]: 1/A_fl, A_fl = 0.06 h^0.7 / (1 + 0.06
/// h^0.7), h in mm (fib Model Code 2010, 5.1-8).
double bending_over_tension_model_code(double depth);
/// The same: max(1.6 - h/1000 mm, 1) (EN 1992-1-1, 3.23).
double bending_over_tension_eurocode(double depth);

/// Axial strength under a confining pressure, both over the uniaxial strength [-].
enum class ConfinementRule {
  richart_1928,  ///< 1 + 4.1 p
  xie_1995,      ///< sqrt(1 + 21.2 p), fitted to concretes of 60 to 119 MPa
  imran_1996,    ///< p + sqrt(1 + 10.571 p), Imran and Pantazopoulou
};
double confined_strength(ConfinementRule rule, double pressure_over_strength);

/// Strain left after unloading in compression over the strain at the peak of the envelope, from the strain at
/// which unloading began over the same (Karsan and Jirsa 1969; a straight line from twice the peak strain on).
double residual_strain_karsan_jirsa(double unloading_strain_ratio);

}  // namespace lab
