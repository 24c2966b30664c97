#include "libdem/search/cell_frame.h"

#include <vector>

namespace dem {
namespace {

// More cells than this per point would mostly be empty.
constexpr double cells_per_point = 4;
// Coordinates beyond this (or not a number) do not take part in choosing the grid: their differences could
// overflow.
constexpr double farthest = 1e150;
constexpr double most_ignored = 0.1;

struct Extent {
  double low = 0, high = 0;
};

// The extent of the finite coordinates along an axis, without the `ignored` fraction of them at each end.
Extent extent_of(std::span<const Vec3> points, int axis, double ignored, std::vector<double>& scratch) {
  scratch.clear();
  for (const Vec3& p : points)
    if (std::abs(p[axis]) < farthest) scratch.push_back(p[axis]);
  if (scratch.empty()) return {};
  const auto skip = static_cast<std::ptrdiff_t>(ignored * static_cast<double>(scratch.size()));
  if (skip == 0) {
    const auto [low, high] = std::minmax_element(scratch.begin(), scratch.end());
    return {*low, *high};
  }
  std::nth_element(scratch.begin(), scratch.begin() + skip, scratch.end());
  std::nth_element(scratch.begin() + skip, scratch.end() - 1 - skip, scratch.end());
  return {scratch[static_cast<std::size_t>(skip)], *(scratch.end() - 1 - skip)};
}

}  // namespace

CellFrame::CellFrame(std::span<const Vec3> from, double cell_size) {
  // A hair larger than asked for, so that a reach equal to the asked size needs one cell on each side, not two.
  size = cell_size * (1 + 1e-6);
  const double most = std::min(cells_per_point * static_cast<double>(from.size()) + 64, 2e9);
  std::vector<double> scratch;
  // Everything fits in nearly every case. Else first leave out the strays at each end of each axis (they go
  // into border cells), more and more of them, then enlarge the cells.
  for (const double ignored : {0.0, 0.01, 0.03, most_ignored}) {
    std::array<Extent, 3> extent;
    for (int axis = 0; axis < 3; ++axis) {
      Extent& along = extent[static_cast<std::size_t>(axis)];
      along = extent_of(from, axis, ignored, scratch);
      if (ignored > 0) {  // what was left out may have been no stray
        const double margin = 0.1 * (along.high - along.low);
        along.low -= margin;
        along.high += margin;
      }
      low[axis] = along.low;
    }
    const auto cells_along = [&](std::size_t axis) {
      return std::floor((extent[axis].high - extent[axis].low) / size) + 1;
    };
    while (ignored == most_ignored && !(cells_along(0) * cells_along(1) * cells_along(2) <= most)) size *= 1.1;
    if (cells_along(0) * cells_along(1) * cells_along(2) <= most) {
      for (std::size_t axis = 0; axis < 3; ++axis) count[axis] = static_cast<std::int64_t>(cells_along(axis));
      return;
    }
  }
}

}  // namespace dem
