#include "specimens/virtual_tests/elastic.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "libdem/law/cohesive_link.h"
#include "libdem/probe/strain_gauge.h"
#include "libdem/statics/static_solve.h"
#include "specimens/virtual_tests/setup.h"

namespace virtual_tests {
namespace {

constexpr double test_strain = 1e-4;  // linear: any value gives the same moduli

/// Number of the element nearest to `target` among those with `accept`.
template <class Accept>
std::size_t nearest(const specimens::Specimen& specimen, const dem::Vec3& target, Accept&& accept) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const double square = (specimen.centres[i] - target).squaredNorm();
    if (square < least && accept(specimen.centres[i])) best = i, least = square;
  }
  return best;
}

}  // namespace

ElasticResult run_elastic(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                          const ElasticOptions& options) {
  const dem::LinkLaw law = dem::make_link_law(card);
  return run_elastic(specimen, law.normal_modulus, law.shear_ratio, options);
}

ElasticResult run_elastic(const specimens::Specimen& specimen, double normal_modulus, double shear_ratio,
                          const ElasticOptions& options, std::vector<double>* guess) {
  const auto start = std::chrono::steady_clock::now();
  const int axis = loading_axis(specimen, options.axis), second = (axis + 1) % 3, third = (axis + 2) % 3;
  const double length = specimen.size[axis], platen = specimen.element_size();
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, normal_modulus, shear_ratio);

  std::vector<std::uint8_t> held(6 * specimen.elements(), 0);
  std::vector<double> displacement =
      guess != nullptr && guess->size() == held.size() ? *guess : std::vector<double>(held.size(), 0.0);
  const bool guessed = guess != nullptr && guess->size() == held.size();
  const auto in_low = [&](const dem::Vec3& x) { return x[axis] < platen; };
  const auto in_high = [&](const dem::Vec3& x) { return x[axis] > length - platen; };
  const auto dof = [](std::size_t i, int c) { return 6 * i + static_cast<std::size_t>(c); };
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const dem::Vec3& x = specimen.centres[i];
    if (in_low(x) || in_high(x)) {
      held[dof(i, axis)] = 1;
      displacement[dof(i, axis)] = in_low(x) ? 0 : test_strain * length;
    } else if (!guessed) {
      displacement[dof(i, axis)] = test_strain * x[axis];
    }
  }
  // Hold just what would drift: the two ends' centres sideways, and one more element against turning about the
  // axis.
  dem::Vec3 low_centre = 0.5 * specimen.size, high_centre = 0.5 * specimen.size, side = 0.5 * specimen.size;
  low_centre[axis] = 0, high_centre[axis] = length, side[axis] = 0, side[third] = 0;
  const std::size_t pin_low = nearest(specimen, low_centre, in_low),
                    pin_high = nearest(specimen, high_centre, in_high);
  const std::size_t pin_turn = nearest(specimen, side, in_low);
  for (const std::size_t pin : {pin_low, pin_high})
    for (const int c : {second, third}) held[dof(pin, c)] = 1, displacement[dof(pin, c)] = 0;
  held[dof(pin_turn, second)] = 1;
  displacement[dof(pin_turn, second)] = 0;

  dem::StaticSolution solution = dem::solve_static(network, held, displacement, options.tolerance);
  double low = 0, high = 0;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    if (in_low(specimen.centres[i])) low += solution.force[dof(i, axis)];
    if (in_high(specimen.centres[i])) high += solution.force[dof(i, axis)];
  }
  const dem::StrainGauge gauge(specimen.centres, gauge_elements(specimen, axis));
  const dem::AxialStrains strain = gauge.measure(solution.displacement);
  const auto along = strain[static_cast<std::size_t>(axis)];
  const auto across =
      0.5 * (strain[static_cast<std::size_t>(second)] + strain[static_cast<std::size_t>(third)]);
  if (guess != nullptr) *guess = std::move(solution.displacement);
  return {0.5 * (high - low) / specimen.section(axis) / along, -across / along, solution.iterations,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace virtual_tests
