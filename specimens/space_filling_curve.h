// The Hilbert curve: numbers near each other are places near each other, so neighbours share cache lines.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"

namespace specimens {

/// The order in which a Hilbert curve through the cube [low, low + side]^3 [m] meets the points: order[k] is
/// the index of the k-th. Points in the same of its 2^60 cells keep their order.
std::vector<std::int32_t> hilbert_order(std::span<const dem::Vec3> points, const dem::Vec3& low, double side);

/// values[order[k]] for each k.
template <class T>
std::vector<T> in_order(std::span<const std::int32_t> order, const std::vector<T>& values) {
  std::vector<T> result;
  result.reserve(order.size());
  for (const std::int32_t k : order) result.push_back(values[static_cast<std::size_t>(k)]);
  return result;
}

}  // namespace specimens
