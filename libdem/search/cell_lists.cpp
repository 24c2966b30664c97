#include "libdem/search/cell_lists.h"

namespace dem {

void CellLists::build(std::span<const Vec3> points, double cell_size) {
  frame = CellFrame(points, cell_size);
  head.assign(frame.cells(), -1);
  next.resize(points.size());
  outside = 0;
  for (std::size_t i = points.size(); i-- > 0;) {  // backwards, so that chains go up in memory
    std::int32_t& first = head[frame.number_of(points[i])];
    next[i] = first;
    first = static_cast<std::int32_t>(i);
    outside += frame.is_outside(points[i]) ? 1 : 0;
  }
  outside_when_built = outside;
}

void CellLists::move(std::size_t i, const Vec3& from, const Vec3& to) {
  outside += (frame.is_outside(to) ? 1 : 0) - (frame.is_outside(from) ? 1 : 0);
  const std::size_t left = frame.number_of(from), entered = frame.number_of(to);
  if (left == entered) return;
  const auto number = static_cast<std::int32_t>(i);
  std::int32_t* link = &head[left];
  while (*link != number) link = &next[static_cast<std::size_t>(*link)];
  *link = next[i];
  next[i] = head[entered];
  head[entered] = number;
}

}  // namespace dem
