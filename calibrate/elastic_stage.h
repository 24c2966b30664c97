// First stage: alpha, beta, gamma of Eq. 1, by least squares over Ks/Kn (Fig. 4), with their covariance.
#pragma once
#include <vector>

#include "libdem/core/vector.h"
#include "specimens/specimen.h"

namespace calibrate {

/// The elastic answer of one specimen at one ratio, per unit normal modulus C = Kn D_init / S_int.
struct ElasticPoint {
  double shear_ratio = 0;    ///< Ks/Kn
  double stiffness = 0;      ///< E/C [-]
  double poisson_ratio = 0;  ///< nu [-]
};

/// Static solves at `ratios`, each starting from its neighbour's solution.
std::vector<ElasticPoint> elastic_response(const specimens::Specimen& specimen,
                                           const std::vector<double>& ratios);

/// The ratios of a fit unless told otherwise: nine from 0.05 to 1.
std::vector<double> default_ratios();

/// alpha, beta, gamma of Eq. 1 and how far it misses the points that it was fitted to.
struct MicroMacroFit {
  double alpha = 0, beta = 0, gamma = 0;
  dem::Mat3 covariance = dem::Mat3::Zero();   ///< of (alpha, beta, gamma)
  double stiffness_rms = 0, poisson_rms = 0;  ///< residuals over the points: relative of E, absolute of nu
};

/// Least squares over measured points, three at least: residuals of E relative, of nu absolute (it tends to 0
/// at Ks/Kn = 1). Throws RunError if they determine nothing.
MicroMacroFit fit_micro_macro(const std::vector<ElasticPoint>& points);

struct ElasticFit {
  double alpha = 0, beta = 0, gamma = 0;
  dem::Mat3 covariance = dem::Mat3::Zero();   ///< of (alpha, beta, gamma)
  double operating_ratio = 0;                 ///< Ks/Kn at which the specimens show the wanted Poisson's ratio
  double stiffness_rms = 0, poisson_rms = 0;  ///< residuals over all ratios: relative of E, absolute of nu
  std::vector<ElasticPoint> points;           ///< that were fitted, all specimens
  std::vector<dem::Vec3> by_specimen;         ///< (alpha, beta, gamma) of each specimen alone
};

/// Fits Eq. 1 to the specimens' answers: residuals of E relative, of nu absolute (it tends to 0 at Ks/Kn = 1).
/// The ratio at which the specimens show `poisson_ratio` is looked up and stands as a tenth point: Eq. 1 is not
/// exact, and the card is for that point. Throws InputError if the specimens cannot show that Poisson's ratio;
/// Interrupted.
ElasticFit fit_elastic(const std::vector<specimens::Specimen>& specimens, double poisson_ratio, int threads);

}  // namespace calibrate
