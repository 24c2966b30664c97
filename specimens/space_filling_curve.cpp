#include "specimens/space_filling_curve.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace specimens {
namespace {

constexpr int bits = 20;

// Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707 (2004): axes to transposed index, then
// interleaved.
std::uint64_t hilbert_number(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (std::uint32_t& along : x) {
      if ((along & q) != 0) {
        x[0] ^= p;
      } else {
        const std::uint32_t swapped = (x[0] ^ along) & p;
        x[0] ^= swapped;
        along ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
    if ((x[2] & q) != 0) flip ^= q - 1;
  std::uint64_t number = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t along : x) number = number << 1 | (((along ^ flip) >> bit) & 1u);
  return number;
}

}  // namespace

std::vector<std::int32_t> hilbert_order(std::span<const dem::Vec3> points, const dem::Vec3& low, double side) {
  constexpr double cells = 1 << bits;
  std::vector<std::uint64_t> numbers;
  numbers.reserve(points.size());
  for (const dem::Vec3& point : points) {
    std::array<std::uint32_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          static_cast<std::uint32_t>(std::clamp((point[axis] - low[axis]) / side * cells, 0.0, cells - 1));
    numbers.push_back(hilbert_number(cell));
  }
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)];
  });
  return order;
}

}  // namespace specimens
