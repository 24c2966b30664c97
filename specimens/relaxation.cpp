#include "specimens/relaxation.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "libdem/search/cell_grid.h"

namespace specimens {
namespace {

// A heavy ball rolling down the energy of the overlaps: momentum carries the long waves that plain pushing
// damps out slowly.
constexpr double push = 0.25;  // share of the summed overlaps by which an element moves
constexpr double momentum = 0.8;
constexpr std::ptrdiff_t block = 512;  // elements whose neighbours one thread lists at a time

// Who may touch whom until something has moved by half the margin; both ends know of each other.
class NeighbourLists {
 public:
  NeighbourLists(std::span<const double> radii_, int threads_)
      : radii(radii_), threads(threads_), largest(*std::max_element(radii_.begin(), radii_.end())) {}

  void build(const std::vector<Vec3>& centres, double margin) {
    built_at = centres;
    allowed = margin / 2;
    grid.build(centres, 2 * largest + margin);
    const auto count = static_cast<std::ptrdiff_t>(centres.size());
    start.assign(centres.size() + 1, 0);
    std::vector<std::vector<std::int32_t>> parts(static_cast<std::size_t>((count + block - 1) / block));
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::ptrdiff_t part = 0; part < static_cast<std::ptrdiff_t>(parts.size()); ++part) {
      auto& mine = parts[static_cast<std::size_t>(part)];
      for (std::ptrdiff_t e = part * block; e < std::min(count, (part + 1) * block); ++e) {
        const auto i = static_cast<std::size_t>(e);
        const std::size_t before = mine.size();
        grid.for_each_near(centres[i], radii[i] + largest + margin, [&](std::int32_t j) {
          const double reach = radii[i] + radii[static_cast<std::size_t>(j)] + margin;
          if (j != e && (centres[static_cast<std::size_t>(j)] - centres[i]).squaredNorm() < reach * reach)
            mine.push_back(j);
        });
        start[i + 1] = static_cast<std::int64_t>(mine.size() - before);
      }
    }
    for (std::size_t i = 0; i < centres.size(); ++i) start[i + 1] += start[i];
    neighbours.clear();
    for (const auto& part : parts) neighbours.insert(neighbours.end(), part.begin(), part.end());
  }

  bool valid_for(const std::vector<Vec3>& centres) const {
    double farthest2 = 0;
    const auto count = static_cast<std::ptrdiff_t>(centres.size());
#pragma omp parallel for schedule(static) reduction(max : farthest2) num_threads(threads)
    for (std::ptrdiff_t e = 0; e < count; ++e) {
      const auto i = static_cast<std::size_t>(e);
      farthest2 = std::max(farthest2, (centres[i] - built_at[i]).squaredNorm());
    }
    return farthest2 < allowed * allowed;
  }

  std::span<const std::int32_t> of(std::size_t i) const {
    return {neighbours.data() + start[i], neighbours.data() + start[i + 1]};
  }

 private:
  std::span<const double> radii;
  int threads;
  double largest;
  double allowed = 0;
  dem::CellGrid grid;
  std::vector<Vec3> built_at;
  std::vector<std::int64_t> start;
  std::vector<std::int32_t> neighbours;
};

Vec3 kept_inside(Vec3 p, double from_faces, Shape shape, const Vec3& size) {
  if (shape == Shape::cylinder) {
    const double axis = size.x() / 2, most = axis - from_faces;
    const double distance = std::hypot(p.x() - axis, p.y() - axis);
    if (distance > most) {
      p.x() = axis + (p.x() - axis) * most / distance;
      p.y() = axis + (p.y() - axis) * most / distance;
    }
    p.z() = std::clamp(p.z(), from_faces, size.z() - from_faces);
    return p;
  }
  for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis], from_faces, size[axis] - from_faces);
  return p;
}

}  // namespace

RelaxationResult relax(std::vector<Vec3>& centres, std::span<const double> radii,
                       const RelaxationOptions& options) {
  RelaxationResult result;
  if (centres.empty()) return result;
  const auto count = static_cast<std::ptrdiff_t>(centres.size());
  double mean_radius = 0;
  for (const double radius : radii) mean_radius += radius / static_cast<double>(count);
  for (std::size_t i = 0; i < centres.size(); ++i)
    centres[i] = kept_inside(centres[i], options.wall_share * radii[i], options.shape, options.size);

  // Below so many elements a thread would wait at the end of each sweep for longer than it works.
  constexpr std::ptrdiff_t elements_per_thread = 8000;
  const int threads =
      static_cast<int>(std::clamp<std::ptrdiff_t>(count / elements_per_thread, 1, options.threads));
  NeighbourLists lists(radii, threads);
  std::vector<Vec3> moved = centres, velocity(centres.size(), Vec3::Zero());
  bool listed = false;
  while (result.sweeps < options.most_sweeps) {
    if (!listed || !lists.valid_for(centres)) {
      // Elements move far at first and hardly at the end: a wide margin saves listing, a narrow one saves
      // looking.
      lists.build(centres, (result.sweeps < 30 ? 0.6 : 0.25) * mean_radius);
      listed = true;
    }
    double largest_overlap = 0;
#pragma omp parallel for schedule(static) reduction(max : largest_overlap) num_threads(threads)
    for (std::ptrdiff_t e = 0; e < count; ++e) {
      const auto i = static_cast<std::size_t>(e);
      Vec3 sum = Vec3::Zero();
      for (const std::int32_t neighbour : lists.of(i)) {
        const auto j = static_cast<std::size_t>(neighbour);
        const Vec3 apart = centres[i] - centres[j];
        const double touching = radii[i] + radii[j], distance2 = apart.squaredNorm();
        if (distance2 >= touching * touching) continue;
        const double distance = std::sqrt(distance2);
        largest_overlap = std::max(largest_overlap, (touching - distance) / touching);
        // Two centres in one place part along x, the lower number to the left.
        sum += distance > 0 ? Vec3(apart * ((touching - distance) / distance))
                            : Vec3(i < j ? -touching : touching, 0, 0);
      }
      const Vec3 aim = centres[i] + momentum * velocity[i] + push * sum;
      moved[i] = kept_inside(aim, options.wall_share * radii[i], options.shape, options.size);
      velocity[i] = moved[i] - centres[i];
    }
    result.largest_overlap = largest_overlap;
    ++result.sweeps;
    if (options.after_sweep) options.after_sweep(result.sweeps, largest_overlap);
    if (largest_overlap <= options.tolerance) break;
    centres.swap(moved);
  }
  return result;
}

}  // namespace specimens
