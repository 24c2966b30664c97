#include "libdem/search/cell_grid.h"

#include <limits>
#include <stdexcept>

namespace dem {

void CellGrid::build(std::span<const Vec3> from, double cell_size) {
  if (!(cell_size > 0) || !std::isfinite(cell_size))
    throw std::invalid_argument("CellGrid: the cell size must be positive and finite");
  if (from.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("CellGrid: too many points for 32-bit indices");
  frame = CellFrame(from, cell_size);

  start.assign(frame.cells() + 1, 0);
  cell_numbers.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    const std::size_t number = frame.number_of(from[k]);
    cell_numbers[k] = static_cast<std::int32_t>(number);
    ++start[number + 1];
  }
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  index.resize(from.size());
  sorted.resize(from.size());
  // While filling, start[c + 1] is the next free slot of cell c; at the end it is that cell's end, as it should
  // be.
  for (std::size_t c = cells(); c > 0; --c) start[c] = start[c - 1];
  start[0] = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto slot = static_cast<std::size_t>(start[static_cast<std::size_t>(cell_numbers[k]) + 1]++);
    index[slot] = static_cast<std::int32_t>(k);
    sorted[slot] = from[k];
  }
}

}  // namespace dem
