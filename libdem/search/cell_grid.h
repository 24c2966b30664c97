// A cell grid over points: who is near whom, in linear time and always in the same order.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/search/cell_frame.h"

namespace dem {

/// Points sorted into cubic cells by counting sort. The grid keeps its own copy of the points, so it stays
/// valid (but describes the past) when they move. Visits are made in an order that depends on the points only,
/// never on threads.
///
/// Points may be anywhere: the memory is bounded by the number of points. A few points that flew far away do
/// not widen the grid; they are kept in its border cells, which costs time there but misses nothing. Points
/// that are not finite are near nobody.
class CellGrid {
 public:
  CellGrid() = default;
  /// `cell_size` [m], positive: best a little above the reach of the searches to come, any reach works.
  /// Throws std::invalid_argument if `cell_size` is not positive and finite, or there are 2^31 points or more.
  CellGrid(std::span<const Vec3> points, double cell_size) { build(points, cell_size); }

  /// Sorts anew, reusing the memory.
  void build(std::span<const Vec3> points, double cell_size);

  /// Calls visit(i, j) once for each unordered pair of points with distance <= reach [m]; i < j (std::int32_t).
  template <class Visit>
  void for_each_pair_within(double reach, Visit&& visit) const {
    for_each_pair_within(reach, 0, cells(), visit);
  }

  /// The part of those pairs that belongs to the cells first_cell <= c < end_cell. Cutting [0, cells()) into
  /// pieces cuts the sequence of visits into pieces: threads may take one each, and their results joined in
  /// order are the same for any number of threads.
  template <class Visit>
  void for_each_pair_within(double reach, std::size_t first_cell, std::size_t end_cell, Visit&& visit) const;

  /// Calls visit(j) for each point with distance <= reach [m] from `point`, which need not be one of the grid's
  /// points nor lie inside the grid; if it is one of them, it is visited too.
  template <class Visit>
  void for_each_near(const Vec3& point, double reach, Visit&& visit) const;

  std::size_t cells() const { return start.empty() ? 0 : start.size() - 1; }
  std::size_t points() const { return index.size(); }
  /// The side of a cell [m]; larger than asked for where the points are spread thinly.
  double cell_size() const { return frame.size; }

 private:
  CellFrame frame;
  std::vector<std::int32_t> start;  // of each cell in `index` and `sorted`
  std::vector<std::int32_t> index;  // of the points, cell by cell, ascending within a cell
  std::vector<Vec3> sorted;         // the points in that order
  std::vector<std::int32_t> cell_numbers;
};

template <class Visit>
void CellGrid::for_each_pair_within(double reach, std::size_t first_cell, std::size_t end_cell,
                                    Visit&& visit) const {
  if (!(reach >= 0)) return;
  const double reach2 = reach * reach;
  const std::int64_t span = frame.span_of(reach);
  const CellFrame::Cell& count = frame.count;
  const auto meet = [&](std::int32_t a, std::int32_t b) {
    const auto ka = static_cast<std::size_t>(a), kb = static_cast<std::size_t>(b);
    if (!((sorted[ka] - sorted[kb]).squaredNorm() <= reach2)) return;
    if (index[ka] < index[kb])
      visit(index[ka], index[kb]);
    else
      visit(index[kb], index[ka]);
  };
  end_cell = std::min(end_cell, cells());
  for (std::size_t c = first_cell; c < end_cell; ++c) {
    const std::int32_t begin = start[c], end = start[c + 1];
    if (begin == end) continue;
    const auto cell = static_cast<std::int64_t>(c);
    const std::int64_t x = cell % count[0], y = cell / count[0] % count[1], z = cell / count[0] / count[1];
    for (std::int32_t a = begin; a < end; ++a)
      for (std::int32_t b = a + 1; b < end; ++b) meet(a, b);
    // The other half of each pair lies in a cell with a higher number; a row of cells is contiguous in
    // `sorted`.
    for (std::int64_t v = z; v <= std::min(z + span, count[2] - 1); ++v)
      for (std::int64_t u = v == z ? y : std::max<std::int64_t>(y - span, 0);
           u <= std::min(y + span, count[1] - 1); ++u) {
        const std::int64_t from = v == z && u == y ? x + 1 : std::max<std::int64_t>(x - span, 0);
        const std::int64_t to = std::min(x + span, count[0] - 1);
        if (from > to) continue;
        const std::int32_t row_begin = start[frame.number_of(from, u, v)],
                           row_end = start[frame.number_of(to, u, v) + 1];
        for (std::int32_t a = begin; a < end; ++a)
          for (std::int32_t b = row_begin; b < row_end; ++b) meet(a, b);
      }
  }
}

template <class Visit>
void CellGrid::for_each_near(const Vec3& point, double reach, Visit&& visit) const {
  if (!(reach >= 0) || cells() == 0) return;
  const double reach2 = reach * reach;
  const auto [from, to] = frame.around(point, reach);
  for (std::int64_t z = from[2]; z <= to[2]; ++z)
    for (std::int64_t y = from[1]; y <= to[1]; ++y) {
      const std::int32_t end = start[frame.number_of(to[0], y, z) + 1];
      for (std::int32_t k = start[frame.number_of(from[0], y, z)]; k < end; ++k) {
        const auto slot = static_cast<std::size_t>(k);
        if ((sorted[slot] - point).squaredNorm() <= reach2) visit(index[slot]);
      }
    }
}

}  // namespace dem
