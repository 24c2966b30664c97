#include "impact/fe/locator.h"

#include <algorithm>
#include <cmath>

#include "impact/fe/hexahedron.h"

namespace fe {

Locator::Locator(const Mesh& of) : mesh(&of) {
  Vec3 high = Vec3::Constant(-1e300), extent = Vec3::Zero();
  low = Vec3::Constant(1e300);
  for (const Vec3& node : mesh->nodes) low = low.cwiseMin(node), high = high.cwiseMax(node);
  for (std::size_t e = 0; e < mesh->elements.size(); ++e) {
    const Corners corners = mesh->corners(e);
    extent += (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).transpose();
  }
  extent /= static_cast<double>(std::max<std::size_t>(1, mesh->elements.size()));
  for (int k = 0; k < 3; ++k) {
    const double span = std::max(high[k] - low[k], 1e-300);
    const int count = static_cast<int>(std::clamp(std::floor(span / std::max(extent[k], 1e-300)), 1.0, 256.0));
    cells[static_cast<std::size_t>(k)] = count;
    cell_size[k] = span / count;
  }
  members.resize(static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
                 static_cast<std::size_t>(cells[2]));
  for (std::size_t e = 0; e < mesh->elements.size(); ++e) {
    const Corners corners = mesh->corners(e);
    const Vec3 from = corners.colwise().minCoeff().transpose(), to = corners.colwise().maxCoeff().transpose();
    const Vec3 margin = 1e-6 * (to - from);
    const auto first = cell_of(from - margin), last = cell_of(to + margin);
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int k = first[2]; k <= last[2]; ++k)
          members[place_of(i, j, k)].push_back(static_cast<std::int32_t>(e));
  }
}

std::size_t Locator::place_of(int i, int j, int k) const {
  return (static_cast<std::size_t>(i) * static_cast<std::size_t>(cells[1]) + static_cast<std::size_t>(j)) *
             static_cast<std::size_t>(cells[2]) +
         static_cast<std::size_t>(k);
}

std::array<int, 3> Locator::cell_of(const Vec3& point) const {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k)
    cell[static_cast<std::size_t>(k)] = static_cast<int>(std::clamp(
        std::floor((point[k] - low[k]) / cell_size[k]), 0.0, cells[static_cast<std::size_t>(k)] - 1.0));
  return cell;
}

std::optional<PointInMesh> Locator::find(const Vec3& point, double tolerance) const {
  if (!point.allFinite()) return std::nullopt;
  const auto [i, j, k] = cell_of(point);
  for (const std::int32_t element : members[place_of(i, j, k)]) {
    const Corners corners = mesh->corners(static_cast<std::size_t>(element));
    const Vec3 from = corners.colwise().minCoeff().transpose(), to = corners.colwise().maxCoeff().transpose();
    const double margin = (tolerance + 1e-6) * (to - from).norm();
    if ((point.array() < from.array() - margin).any() || (point.array() > to.array() + margin).any()) continue;
    const std::optional<Vec3> local = local_coordinates(corners, point);
    if (local && local->cwiseAbs().maxCoeff() <= 1 + tolerance) return PointInMesh{element, *local};
  }
  return std::nullopt;
}

}  // namespace fe
