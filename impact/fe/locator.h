// Which element a point lies in, and where in it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "impact/fe/mesh.h"

namespace fe {

struct PointInMesh {
  std::int32_t element = 0;
  Vec3 local = Vec3::Zero();  ///< local coordinates, -1 to 1
};

/// Finds points in a mesh: a grid of cells over the elements' bounding boxes, then the inverse mapping. The
/// mesh must outlive it.
class Locator {
 public:
  explicit Locator(const Mesh& mesh);

  /// The element that holds the point, the one with the lowest number where elements meet; nothing outside all
  /// of them. A point counts as inside while its local coordinates exceed 1 by `tolerance` at most.
  std::optional<PointInMesh> find(const Vec3& point, double tolerance = 1e-9) const;

 private:
  std::array<int, 3> cell_of(const Vec3& point) const;
  std::size_t place_of(int i, int j, int k) const;

  const Mesh* mesh;
  Vec3 low = Vec3::Zero(), cell_size = Vec3::Ones();
  std::array<int, 3> cells = {1, 1, 1};
  std::vector<std::vector<std::int32_t>>
      members;  ///< by cell: elements whose bounding box touches it, ascending
};

}  // namespace fe
