// Fracture energy and tensile strength over a factor of three in element size, the card as it is and rescaled
// by libdem/material/element_size_rule.h: docs/validation.md, "Fracture energy".
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "bench/validation_parts.h"
#include "libdem/core/parallel.h"
#include "libdem/material/element_size_rule.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace bench {
namespace {

constexpr std::size_t counts[] = {1100, 3300, 9900, 29700, 89100};
constexpr std::size_t first_of_spread = 1;  // the coarsest has only eight elements across
constexpr std::uint64_t seeds = 3;

specimens::Specimen prism(std::size_t elements, std::uint64_t seed) {
  specimens::PackingOptions packing;
  packing.size = {0.3, 0.15, 0.15};
  packing.elements = elements;
  packing.seed = seed;
  packing.threads = 1;
  return specimens::make_specimen(packing);
}

struct Point {
  double size = 0, strength = 0, energy = 0;
};

/// Means over the seeds at each size; `rescaled`: the card follows the size, from that of the second.
std::vector<Point> measure(const dem::MaterialCard& card, bool rescaled) {
  const double reference = prism(counts[1], 1).element_size();
  std::vector<Point> points;
  for (const std::size_t elements : counts) {
    std::vector<Point> each(seeds);
    dem::for_each_in_parallel(seeds, 2, [&](std::size_t k) {
      const specimens::Specimen specimen = prism(elements, k + 1);
      const double size = specimen.element_size();
      virtual_tests::UniaxialOptions options;
      options.rate = 0.06;
      options.stop_at = 0.05;
      options.max_strain = 0.008;
      const auto found = virtual_tests::run_uniaxial(
          specimen, rescaled ? dem::for_element_size(card, reference, size) : card, options);
      each[k] = {size, found.peak_stress, found.work_of_fracture};
    });
    Point mean;
    for (const Point& p : each)
      mean.size += p.size / seeds, mean.strength += p.strength / seeds, mean.energy += p.energy / seeds;
    points.push_back(mean);
  }
  return points;
}

/// (max - min)/mean over the factor of three from the second size to the last.
template <class Member>
double spread(const std::vector<Point>& points, Member member) {
  double low = 1e300, high = 0, sum = 0;
  for (std::size_t k = first_of_spread; k < points.size(); ++k)
    low = std::min(low, points[k].*member), high = std::max(high, points[k].*member), sum += points[k].*member;
  return (high - low) / (sum / static_cast<double>(points.size() - first_of_spread));
}

}  // namespace

void validate_fracture() {
  const std::filesystem::path cards = std::filesystem::path(SPALL_CASES).parent_path() / "cards";
  const char* name = "bam-m7-moment.toml";
  const dem::MaterialCard card = dem::read_card(cards / name);
  for (const bool rescaled : {false, true}) {
    fmt::print("== fracture: {}, prism of 0.3 x 0.15 x 0.15 m, {} seeds, {}\n", name, seeds,
               rescaled ? "T and zeta rescaled with the element size" : "the card as it is");
    const std::vector<Point> points = measure(card, rescaled);
    for (const Point& p : points)
      fmt::print("element size {:5.1f} mm: ft {:.2f} MPa, Gf {:.0f} J/m2\n", 1e3 * p.size, p.strength / 1e6,
                 p.energy);
    fmt::print("(max - min)/mean without the coarsest, over a factor of {:.1f}: ft {:.1f}%, Gf {:.1f}%\n",
               points[first_of_spread].size / points.back().size, 100 * spread(points, &Point::strength),
               100 * spread(points, &Point::energy));
  }
}

}  // namespace bench
