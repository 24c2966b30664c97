// A cell grid over points that move one by one: who is near a place, without sorting everything again.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/search/cell_frame.h"

namespace dem {

/// Points in cubic cells, each cell a chain of their numbers. To move a point costs the same however many there
/// are. The points themselves are the caller's and are handed in at every call. Visits come in an order that
/// depends on the history of moves: sort what is found.
class CellLists {
 public:
  /// `cell_size` [m], positive: best a little above the reach of the searches to come.
  void build(std::span<const Vec3> points, double cell_size);

  /// Point i was at `from` and is at `to`.
  void move(std::size_t i, const Vec3& from, const Vec3& to);

  /// True when so many points have left the box of cells that it should be built again.
  bool is_outgrown() const {
    return outside > 2 * outside_when_built + static_cast<std::int64_t>(next.size() / 64);
  }

  std::size_t points() const { return next.size(); }

  /// Calls visit(j, square) for each point with distance <= reach [m] from `point`; `square` is that
  /// distance's.
  template <class Visit>
  void for_each_near(std::span<const Vec3> points, const Vec3& point, double reach, Visit&& visit) const {
    if (!(reach >= 0) || next.empty()) return;
    const double reach2 = reach * reach;
    const auto [from, to] = frame.around(point, reach);
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        const std::size_t row_end = frame.number_of(to[0], y, z) + 1;
        for (std::size_t cell = frame.number_of(from[0], y, z); cell < row_end; ++cell)
          for (std::int32_t j = head[cell]; j >= 0; j = next[static_cast<std::size_t>(j)])
            if (const double square = (points[static_cast<std::size_t>(j)] - point).squaredNorm();
                square <= reach2)
              visit(j, square);
      }
  }

 private:
  CellFrame frame;
  std::vector<std::int32_t> head;  ///< of each cell's chain, -1 if it is empty
  std::vector<std::int32_t> next;  ///< of each point in its chain, -1 at the end
  std::int64_t outside = 0, outside_when_built = 0;
};

}  // namespace dem
