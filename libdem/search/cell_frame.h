// Where the cells of a grid lie: space cut into cubes, numbered row by row.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "libdem/core/vector.h"

namespace dem {

/// A box of cubic cells about most of the points that it is made for. Places outside belong to the border
/// cells, so every place has a cell, and two places within reach of each other stay within `span_of(reach)`
/// cells.
struct CellFrame {
  using Cell = std::array<std::int64_t, 3>;

  Vec3 low = Vec3::Zero();
  double size = 1;  ///< of a cell [m]
  Cell count{1, 1, 1};

  CellFrame() = default;
  /// Cells of `cell_size` [m], positive, or larger where the points are spread thinly: there are at most four
  /// cells a point, and some more. A few points that flew far away do not widen the box.
  CellFrame(std::span<const Vec3> points, double cell_size);

  std::size_t cells() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
  // Clamping keeps the order along an axis.
  std::int64_t cell_along(int axis, double x) const {
    const double position = std::floor((x - low[axis]) / size);
    if (!(position > 0)) return 0;  // also when x is not a number
    const double last = static_cast<double>(count[static_cast<std::size_t>(axis)] - 1);
    return static_cast<std::int64_t>(std::min(position, last));
  }
  Cell cell_of(const Vec3& p) const {
    return {cell_along(0, p.x()), cell_along(1, p.y()), cell_along(2, p.z())};
  }
  std::size_t number_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * count[1] + y) * count[0] + x);
  }
  std::size_t number_of(const Vec3& p) const {
    const Cell cell = cell_of(p);
    return number_of(cell[0], cell[1], cell[2]);
  }
  /// Cells to look at on each side; the small number covers the rounding of cell_along.
  std::int64_t span_of(double reach) const {
    const double span = std::ceil(reach / size + 1e-7);
    const auto most = static_cast<double>(std::max({count[0], count[1], count[2]}));
    return static_cast<std::int64_t>(std::clamp(span, 0.0, most));
  }
  /// The cells that hold everything within `reach` of a point: first and last along each axis.
  std::pair<Cell, Cell> around(const Vec3& point, double reach) const {
    const std::int64_t span = span_of(reach);
    const Cell at = cell_of(point);
    Cell from, to;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = std::max<std::int64_t>(at[axis] - span, 0);
      to[axis] = std::min(at[axis] + span, count[axis] - 1);
    }
    return {from, to};
  }
  bool is_outside(const Vec3& p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (!(p[axis] >= low[axis] &&
            p[axis] <= low[axis] + size * static_cast<double>(count[static_cast<std::size_t>(axis)])))
        return true;
    return false;
  }
};

}  // namespace dem
