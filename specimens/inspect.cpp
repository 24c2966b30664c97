#include "specimens/inspect.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "specimens/interaction_range.h"
#include "specimens/isotropy.h"
#include "specimens/representative.h"

namespace specimens {
namespace {

// Volume of the part of a sphere that lies below height x above its centre.
double volume_below(double x, double radius) {
  x = std::clamp(x, -radius, radius);
  return std::numbers::pi * (radius * radius * x - x * x * x / 3 + 2 * radius * radius * radius / 3);
}

double density_variation_of(const Specimen& specimen) {
  const int axis = specimen.long_axis();
  const double length = specimen.size[axis];
  const auto slices = static_cast<std::ptrdiff_t>(std::max(length / (2 * specimen.element_size()), 1.0));
  if (slices < 4) return 0;  // the two at the faces do not count
  const double thickness = length / static_cast<double>(slices);
  std::vector<double> solid(static_cast<std::size_t>(slices), 0.0);
  for (std::size_t k = 0; k < specimen.elements(); ++k) {
    const double at = specimen.centres[k][axis], radius = specimen.radii[k];
    const auto slice_of = [&](double x) {
      return std::clamp(static_cast<std::ptrdiff_t>(std::floor(x / thickness)), std::ptrdiff_t{0}, slices - 1);
    };
    for (std::ptrdiff_t slice = slice_of(at - radius); slice <= slice_of(at + radius); ++slice) {
      const double low = static_cast<double>(slice) * thickness - at;
      solid[static_cast<std::size_t>(slice)] +=
          volume_below(low + thickness, radius) - volume_below(low, radius);
    }
  }
  double mean = 0, squares = 0;
  for (std::size_t k = 1; k + 1 < solid.size(); ++k) {
    mean += solid[k] / static_cast<double>(slices - 2);
    squares += solid[k] * solid[k] / static_cast<double>(slices - 2);
  }
  return std::sqrt(std::max(squares - mean * mean, 0.0)) / mean;
}

}  // namespace

Inspection inspect(const Specimen& specimen) {
  Inspection found;
  found.shape = name_of(specimen.shape);
  found.size = specimen.size;
  found.origin = specimen.origin;
  found.seed = specimen.seed;
  found.elements = specimen.elements();
  found.links = specimen.links.size();
  found.interaction_radius_factor = specimen.interaction_radius_factor;
  found.volume = specimen.volume();
  found.element_size = specimen.element_size();
  found.sha256 = specimen.sha256();
  found.not_representative_because = why_not_representative(specimen);
  found.representative = found.not_representative_because.empty();
  if (specimen.elements() == 0) return found;

  const auto internal = internal_elements(specimen);
  found.internal_elements = std::accumulate(internal.begin(), internal.end(), std::size_t{0});
  found.mean_interior_coordination = mean_interior_coordination(specimen);
  found.elements_across = specimen.size.minCoeff() / found.element_size;
  found.density_variation = density_variation_of(specimen);
  const auto [smallest, largest] = std::minmax_element(specimen.radii.begin(), specimen.radii.end());
  found.radius_min = *smallest;
  found.radius_max = *largest;
  for (const double radius : specimen.radii) {
    found.radius_mean += radius / static_cast<double>(specimen.elements());
    found.solid_fraction += 4 * std::numbers::pi / 3 * radius * radius * radius / found.volume;
  }
  for (const Link& link : specimen.links) {
    const double touching =
        specimen.radii[static_cast<std::size_t>(link.a)] + specimen.radii[static_cast<std::size_t>(link.b)];
    found.largest_overlap = std::max(found.largest_overlap, 1 - link.initial_distance / touching);
  }
  const Isotropy isotropy = isotropy_of(specimen);
  found.fabric_eigenvalues = isotropy.eigenvalues;
  found.fabric_tolerance = isotropy.tolerance;
  found.fabric_fourth_moment = isotropy.fourth_moment;
  found.isotropic = isotropy.isotropic;
  found.orientation_histogram = orientation_histogram(specimen);
  return found;
}

nlohmann::json to_json(const Inspection& found) {
  return {{"shape", found.shape},
          {"size", {found.size.x(), found.size.y(), found.size.z()}},
          {"origin", found.origin},
          {"seed", found.seed},
          {"elements", found.elements},
          {"internal_elements", found.internal_elements},
          {"links", found.links},
          {"mean_interior_coordination", found.mean_interior_coordination},
          {"interaction_radius_factor", found.interaction_radius_factor},
          {"volume", found.volume},
          {"solid_fraction", found.solid_fraction},
          {"density_variation", found.density_variation},
          {"element_size", found.element_size},
          {"elements_across", found.elements_across},
          {"radius_min", found.radius_min},
          {"radius_max", found.radius_max},
          {"radius_mean", found.radius_mean},
          {"largest_overlap", found.largest_overlap},
          {"fabric_eigenvalues", found.fabric_eigenvalues},
          {"fabric_tolerance", found.fabric_tolerance},
          {"fabric_fourth_moment", found.fabric_fourth_moment},
          {"isotropic", found.isotropic},
          {"orientation_histogram",
           {{"xy", found.orientation_histogram[0]},
            {"yz", found.orientation_histogram[1]},
            {"zx", found.orientation_histogram[2]}}},
          {"representative", found.representative},
          {"not_representative_because", found.not_representative_because},
          {"sha256", found.sha256}};
}

}  // namespace specimens
