#include "specimens/isotropy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "specimens/interaction_range.h"

namespace specimens {
namespace {

// visit(n, ends): the direction of each link and how many internal elements it belongs to. Counting only links
// with two internal ends would favour those along the faces: the internal region has a border too, and cuts
// those across it.
template <class Visit>
void for_each_internal_direction(const Specimen& specimen, Visit&& visit) {
  const auto internal = internal_elements(specimen);
  for (const Link& link : specimen.links) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    const int ends = internal[a] + internal[b];
    const Vec3 between = specimen.centres[b] - specimen.centres[a];
    const double length = between.norm();
    if (ends > 0 && length > 0) visit(Vec3(between / length), static_cast<double>(ends));
  }
}

}  // namespace

Isotropy isotropy_of(const Specimen& specimen) {
  Isotropy result;
  double total = 0;  // ends of links in internal elements
  for_each_internal_direction(specimen, [&](const Vec3& n, double ends) {
    ++result.links;
    total += ends;
    result.fabric += ends * n * n.transpose();
    result.fourth_moment += ends * n.array().square().square().sum();
  });
  if (result.links == 0) return result;
  const auto count = static_cast<double>(result.links);
  result.fabric /= total;
  result.fourth_moment /= total;
  const Eigen::SelfAdjointEigenSolver<dem::Mat3> solver(result.fabric, Eigen::EigenvaluesOnly);
  double deviation = 0;
  for (int k = 0; k < 3; ++k) {
    const double value = solver.eigenvalues()[k];
    result.eigenvalues[static_cast<std::size_t>(k)] = value;
    deviation = std::max(deviation, std::abs(value - 1.0 / 3));
  }
  result.tolerance = 0.02 + 2 * std::sqrt(4.0 / 45 / count);
  result.isotropic = deviation <= result.tolerance;
  return result;
}

std::array<std::vector<double>, 3> orientation_histogram(const Specimen& specimen, std::size_t bins) {
  std::array<std::vector<double>, 3> histogram;
  histogram.fill(std::vector<double>(bins, 0.0));
  double total = 0;
  for_each_internal_direction(specimen, [&](const Vec3& n, double ends) {
    total += ends;
    for (int plane = 0; plane < 3; ++plane) {
      const double angle = std::atan2(n[(plane + 1) % 3], n[plane]);
      const double turn =
          angle / std::numbers::pi + (angle < 0 ? 1 : 0);  // a link has no sense: half a turn counts
      const auto bin = static_cast<std::size_t>(turn * static_cast<double>(bins));
      histogram[static_cast<std::size_t>(plane)][std::min(bin, bins - 1)] += ends;
    }
  });
  if (total > 0)
    for (auto& plane : histogram)
      for (double& value : plane) value *= static_cast<double>(bins) / total;
  return histogram;
}

}  // namespace specimens
