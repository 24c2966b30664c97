// Where links point (the paper's Fig. 2), against pointing everywhere alike.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "libdem/core/vector.h"

namespace study::statistics {

/// Directions counted in cells of the half sphere, since a link has no sense. theta is the angle from the polar
/// axis (0 to pi/2), phi the angle around it (0 to 2 pi). The cells are even in cos(theta) and in phi, so that
/// all have the same solid angle.
struct OrientationHistogram {
  std::size_t theta_bins = 0, phi_bins = 0;
  std::vector<double> counts;  ///< theta by theta, theta 0 first; theta_bins * phi_bins
  double total = 0;

  /// Count over that of an even distribution: 1 everywhere when uniform.
  double relative(std::size_t theta, std::size_t phi) const;
  /// The same for whole rings of theta, and for whole sectors of phi.
  std::vector<double> relative_by_theta() const;
  std::vector<double> relative_by_phi() const;
};

/// `directions`: vectors of any length above 0. `polar_axis`: 0, 1 or 2 for x, y, z; phi counts from the axis
/// after it in that order. Throws std::invalid_argument for bins of 0, an axis above 2, or a null vector.
OrientationHistogram orientation_histogram(std::span<const dem::Vec3> directions, std::size_t theta_bins,
                                           std::size_t phi_bins, int polar_axis = 2);

/// Adds the counts of another histogram with the same cells. Throws std::invalid_argument otherwise.
void add(OrientationHistogram& sum, const OrientationHistogram& other);

/// Pearson's chi-square of the counts against even ones. p takes links for independent draws, which those of
/// one element are not quite: it is a mark, not proof. Small p with a small deviation means many links.
struct Uniformity {
  double chi_square = 0, p = 0;
  std::size_t degrees = 0;
  double deviation = 0;           ///< standard deviation of the relative counts [-]
  double expected_deviation = 0;  ///< of as many independent, uniform directions: sqrt(cells / total)
};
/// Throws std::invalid_argument if nothing was counted or there is one cell only.
Uniformity uniformity(const OrientationHistogram& histogram);

}  // namespace study::statistics
