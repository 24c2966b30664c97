#include "study/statistics/orientation.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace study::statistics {

double OrientationHistogram::relative(std::size_t theta, std::size_t phi) const {
  return counts.at(theta * phi_bins + phi) * static_cast<double>(counts.size()) / total;
}

std::vector<double> OrientationHistogram::relative_by_theta() const {
  std::vector<double> rings(theta_bins, 0.0);
  for (std::size_t k = 0; k < counts.size(); ++k)
    rings[k / phi_bins] += counts[k] * static_cast<double>(theta_bins) / total;
  return rings;
}

std::vector<double> OrientationHistogram::relative_by_phi() const {
  std::vector<double> sectors(phi_bins, 0.0);
  for (std::size_t k = 0; k < counts.size(); ++k)
    sectors[k % phi_bins] += counts[k] * static_cast<double>(phi_bins) / total;
  return sectors;
}

OrientationHistogram orientation_histogram(std::span<const dem::Vec3> directions, std::size_t theta_bins,
                                           std::size_t phi_bins, int polar_axis) {
  if (theta_bins == 0 || phi_bins == 0 || polar_axis < 0 || polar_axis > 2)
    throw std::invalid_argument("orientation_histogram: bins above 0 and an axis 0, 1 or 2");
  OrientationHistogram histogram{theta_bins, phi_bins, std::vector<double>(theta_bins * phi_bins, 0.0), 0};
  const auto bin = [](double share, std::size_t bins) {
    return std::min(static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(bins)), bins - 1);
  };
  for (const dem::Vec3& direction : directions) {
    const double length = direction.norm();
    if (!(length > 0)) throw std::invalid_argument("orientation_histogram: a direction of no length");
    const dem::Vec3 n = direction / (direction[polar_axis] < 0 ? -length : length);
    const double turn = std::atan2(n[(polar_axis + 2) % 3], n[(polar_axis + 1) % 3]) / (2 * std::numbers::pi);
    const std::size_t theta = bin(1 - n[polar_axis], theta_bins),
                      phi = bin(turn < 0 ? turn + 1 : turn, phi_bins);
    histogram.counts[theta * phi_bins + phi] += 1;
    histogram.total += 1;
  }
  return histogram;
}

void add(OrientationHistogram& sum, const OrientationHistogram& other) {
  if (sum.theta_bins != other.theta_bins || sum.phi_bins != other.phi_bins)
    throw std::invalid_argument("orientation histograms with different cells");
  for (std::size_t k = 0; k < sum.counts.size(); ++k) sum.counts[k] += other.counts[k];
  sum.total += other.total;
}

Uniformity uniformity(const OrientationHistogram& histogram) {
  const std::size_t cells = histogram.counts.size();
  if (!(histogram.total > 0) || cells < 2)
    throw std::invalid_argument("uniformity: needs directions and two cells");
  const double expected = histogram.total / static_cast<double>(cells);
  Uniformity result;
  result.degrees = cells - 1;
  for (const double count : histogram.counts)
    result.chi_square += (count - expected) * (count - expected) / expected;
  result.p = gsl_cdf_chisq_Q(result.chi_square, static_cast<double>(result.degrees));
  result.deviation = std::sqrt(result.chi_square / expected / static_cast<double>(cells));
  result.expected_deviation = std::sqrt(1 / expected);
  return result;
}

}  // namespace study::statistics
