#include "calibrate/lab/measure.h"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>

#include "calibrate/lab/curve.h"
#include "libdem/core/error.h"

namespace lab {
namespace {

/// The strain at which the stress last passes `level` on its way up to the peak.
double strain_at_level(const LabCurve& curve, double level) {
  std::size_t k = peak_index(curve);
  if (curve.stress[k] < level)
    throw dem::InputError(curve.file,
                          fmt::format("the curve reaches {:.4g} MPa, the modulus needs {:.4g} MPa",
                                      curve.stress[k] / 1e6, level / 1e6),
                          "give a curve that covers one tenth to one third of the strength");
  while (k > 0 && curve.stress[k] > level) --k;
  if (curve.stress[k] > level)
    throw dem::InputError(curve.file,
                          fmt::format("the loading begins at {:.4g} MPa, the modulus needs {:.4g} MPa",
                                      curve.stress[k] / 1e6, level / 1e6),
                          "give a curve that covers one tenth to one third of the strength");
  if (curve.stress[k] == level) return curve.strain[k];
  const double part = (level - curve.stress[k]) / (curve.stress[k + 1] - curve.stress[k]);
  return curve.strain[k] + part * (curve.strain[k + 1] - curve.strain[k]);
}

}  // namespace

double strength(const LabCurve& curve) { return curve.stress[peak_index(curve)]; }
double strain_at_peak(const LabCurve& curve) { return curve.strain[peak_index(curve)]; }

double secant_modulus(const LabCurve& curve) { return secant_modulus(curve, strength(curve)); }

double secant_modulus(const LabCurve& curve, double strength, double lower, double upper) {
  const double run = strain_at_level(curve, upper * strength) - strain_at_level(curve, lower * strength);
  if (!(run > 0))
    throw dem::InputError(curve.file,
                          "the strain does not grow between one tenth and one third of the strength",
                          "check the strain column");
  return (upper - lower) * strength / run;
}

StraightPart fit_straight_part(const LabCurve& curve, double lower, double upper) {
  const std::size_t peak = peak_index(curve);
  const double top = curve.stress[peak];
  std::vector<double> strain;
  std::vector<double> stress;
  for (std::size_t k = 0; k < peak; ++k) {
    if (curve.stress[k] < lower * top || curve.stress[k] > upper * top) continue;
    strain.push_back(curve.strain[k]);
    stress.push_back(curve.stress[k]);
  }
  // A curve with few rows there still has its two crossings.
  if (strain.size() < 3) {
    strain = {strain_at_level(curve, lower * top), strain_at_level(curve, upper * top)};
    stress = {lower * top, upper * top};
  }
  double intercept = 0, slope = 0, cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  gsl_fit_linear(strain.data(), 1, stress.data(), 1, strain.size(), &intercept, &slope, &cov00, &cov01, &cov11,
                 &squares);
  if (!(slope > 0) || !std::isfinite(slope))
    throw dem::InputError(
        curve.file,
        fmt::format("the stress does not rise with the strain from {:g} to {:g} of the strength", lower, upper),
        "check the strain column");
  return {slope, -intercept / slope};
}

double fitted_modulus(const LabCurve& curve, double lower, double upper) {
  return fit_straight_part(curve, lower, upper).slope;
}

std::optional<double> strain_after_peak(const LabCurve& curve, double fraction) {
  const std::size_t peak = peak_index(curve);
  const double level = fraction * curve.stress[peak];
  for (std::size_t k = peak + 1; k < curve.size(); ++k) {
    if (curve.stress[k] > level) continue;
    const double part = (curve.stress[k - 1] - level) / (curve.stress[k - 1] - curve.stress[k]);
    return curve.strain[k - 1] + part * (curve.strain[k] - curve.strain[k - 1]);
  }
  return std::nullopt;
}

double fracture_energy(const OpeningCurve& curve, bool to_zero) {
  const auto& w = curve.opening;
  const auto& s = curve.stress;
  const double top = s.empty() ? 0 : *std::ranges::max_element(s);
  if (w.size() < 2 || s.back() > top / 3)
    throw dem::InputError(curve.file, "the stress does not fall to one third of its peak: the area says little",
                          "give the curve to larger openings");
  double area = 0;
  for (std::size_t k = 1; k < w.size(); ++k) area += (w[k] - w[k - 1]) * (s[k] + s[k - 1]) / 2;
  if (to_zero && s.back() > 0) {
    const std::size_t quarter = w.size() - std::max<std::size_t>(2, w.size() / 4);
    const double slope = (s[quarter] - s.back()) / (w.back() - w[quarter]);
    if (slope > 0) area += s.back() * s.back() / (2 * slope);
  }
  return area;
}

}  // namespace lab
