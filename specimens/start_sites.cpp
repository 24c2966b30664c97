#include "specimens/start_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "specimens/space_filling_curve.h"

namespace specimens {
namespace {

struct Lattice {
  std::vector<Vec3> sites;
  Vec3 spacing = Vec3::Zero();
};

// nx * ny * nz >= count cells, as few as possible but nearly cubic.
Lattice box_lattice(const Vec3& size, std::size_t count) {
  const double wanted = std::cbrt(size.prod() / static_cast<double>(count));
  std::array<std::int64_t, 3> best{1, 1, 1};
  double best_cost = std::numeric_limits<double>::infinity();
  const auto around = [&](int axis, int offset) {
    return std::max<std::int64_t>(std::llround(size[axis] / wanted) + offset, 1);
  };
  for (int i = -2; i <= 3; ++i)
    for (int j = -2; j <= 3; ++j)
      for (int k = -2; k <= 3; ++k) {
        const std::array<std::int64_t, 3> n{around(0, i), around(1, j), around(2, k)};
        const auto cells = static_cast<double>(n[0] * n[1] * n[2]);
        if (cells < static_cast<double>(count)) continue;
        double uneven = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double ratio = size[axis] / static_cast<double>(n[static_cast<std::size_t>(axis)]) / wanted;
          uneven = std::max(uneven, std::abs(ratio - 1));
        }
        const double cost = cells / static_cast<double>(count) - 1 + uneven;
        if (cost < best_cost) {
          best_cost = cost;
          best = n;
        }
      }
  if (!std::isfinite(best_cost))  // a very flat or thin shape: fill its longest side
    for (std::size_t axis = 0; axis < 3; ++axis)
      best[axis] = static_cast<std::int64_t>(std::ceil(size[static_cast<int>(axis)] / wanted)) + 1;
  Lattice lattice;
  for (int axis = 0; axis < 3; ++axis)
    lattice.spacing[axis] = size[axis] / static_cast<double>(best[static_cast<std::size_t>(axis)]);
  for (std::int64_t z = 0; z < best[2]; ++z)
    for (std::int64_t y = 0; y < best[1]; ++y)
      for (std::int64_t x = 0; x < best[0]; ++x)
        lattice.sites.emplace_back(
            Vec3(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, static_cast<double>(z) + 0.5)
                .cwiseProduct(lattice.spacing));
  return lattice;
}

// Layers of sunflower spirals: even up to the round edge, for any number of sites.
Lattice cylinder_lattice(const Vec3& size, std::size_t count, dem::Random& random) {
  const double radius = size.x() / 2;
  const double wanted = std::cbrt(std::numbers::pi * radius * radius * size.z() / static_cast<double>(count));
  const auto layers = static_cast<std::size_t>(std::max(std::llround(size.z() / wanted), 1ll));
  const std::size_t per_layer = (count + layers - 1) / layers;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  Lattice lattice;
  lattice.spacing.setConstant(wanted);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const double z = (static_cast<double>(layer) + 0.5) * size.z() / static_cast<double>(layers);
    for (std::size_t k = 0; k < per_layer; ++k) {
      const double from_axis =
          radius * std::sqrt((static_cast<double>(k) + 0.5) / static_cast<double>(per_layer));
      const double angle = turn + golden_angle * static_cast<double>(k);
      lattice.sites.emplace_back(radius + from_axis * std::cos(angle), radius + from_axis * std::sin(angle), z);
    }
  }
  return lattice;
}

template <class T>
void shuffle(std::vector<T>& values, dem::Random& random) {
  for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[random.below(k)]);
}

}  // namespace

std::vector<Vec3> start_sites(Shape shape, const Vec3& size, std::size_t count, dem::Random& random) {
  Lattice lattice = shape == Shape::box ? box_lattice(size, count) : cylinder_lattice(size, count, random);
  lattice.sites = in_order(hilbert_order(lattice.sites, Vec3::Zero(), size.maxCoeff()), lattice.sites);

  // The surplus sites stay vacant: one at random in each equal stretch of the curve.
  const std::size_t surplus = lattice.sites.size() - count;
  std::vector<Vec3> kept;
  kept.reserve(count);
  std::size_t begin = 0;
  for (std::size_t stretch = 0; stretch < surplus; ++stretch) {
    const std::size_t end = (stretch + 1) * lattice.sites.size() / surplus;
    const std::size_t vacant = begin + random.below(end - begin);
    for (std::size_t k = begin; k < end; ++k)
      if (k != vacant) kept.push_back(lattice.sites[k]);
    begin = end;
  }
  kept.insert(kept.end(), lattice.sites.begin() + static_cast<std::ptrdiff_t>(begin), lattice.sites.end());

  for (Vec3& site : kept)
    for (int axis = 0; axis < 3; ++axis) site[axis] += lattice.spacing[axis] * random.uniform(-0.5, 0.5);
  return kept;
}

std::vector<double> spread_evenly(const std::vector<double>& radii, dem::Random& random) {
  constexpr std::size_t stretch = 8;
  std::array<std::vector<std::size_t>, stretch> sites_of_rank;  // one site per stretch and eighth
  for (std::size_t begin = 0; begin < radii.size(); begin += stretch) {
    std::vector<std::size_t> sites(std::min(stretch, radii.size() - begin));
    std::iota(sites.begin(), sites.end(), begin);
    shuffle(sites, random);
    for (std::size_t rank = 0; rank < sites.size(); ++rank) sites_of_rank[rank].push_back(sites[rank]);
  }
  std::vector<double> spread(radii.size());
  std::size_t next = 0;
  for (std::vector<std::size_t>& sites : sites_of_rank) {
    shuffle(sites, random);
    for (const std::size_t site : sites) spread[site] = radii[next++];
  }
  return spread;
}

}  // namespace specimens
