// A closed surface of triangles: signed distance by a tree of boxes and angle-weighted pseudo-normals.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "libdem/core/vector.h"

namespace impact {

using dem::Mat3;
using dem::Vec3;

/// What is nearest to a point on a surface.
struct Nearest {
  double distance = 0;         ///< from the surface, negative inside [m]
  Vec3 point = Vec3::Zero();   ///< of the surface [m]
  Vec3 normal = Vec3::Zero();  ///< outward, the gradient of the distance
};

/// Corners of each triangle, anticlockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// Checked when made: closed, consistently oriented, facing outward, nothing degenerate. That a surface does
/// not cut through itself is not checked.
class TriangleMesh {
 public:
  /// `vertices` [m]; points with the same coordinates count as one. Throws InputError that names `name` (the
  /// file) and the triangle, counted from 1, if there is none, a coordinate is not finite, a triangle has no
  /// area, an edge does not belong to just two triangles, two neighbours are oriented against each other, or
  /// all of them face inward.
  TriangleMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
               const std::string& name);

  /// Exact; inside and outside are told apart by the pseudo-normal of the face, edge or vertex that is nearest
  /// (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243). Of equally near triangles the one
  /// that comes first in the tree is taken.
  Nearest nearest(const Vec3& point) const;

  const std::vector<Vec3>& vertices() const { return points; }
  /// In the order given to the constructor.
  const std::vector<Triangle>& triangles() const { return corners; }
  Eigen::AlignedBox3d bounding_box() const { return nodes.front().box; }
  void translate(const Vec3& by);

 private:
  /// Children of an inner node are `first` and `first` + 1; a leaf holds `count` entries of `order`.
  struct Node {
    Eigen::AlignedBox3d box;
    std::int32_t first = 0, count = 0;
  };
  void require_area(const std::string& name) const;
  void find_normals(const std::string& name);
  void build_tree();
  void split(std::size_t node, const std::vector<Vec3>& middles);
  void fit_boxes();

  std::vector<Vec3> points;
  std::vector<Triangle> corners;
  std::vector<Vec3> face_normal, vertex_normal;
  std::vector<std::array<Vec3, 3>> edge_normal;  ///< of the edges 01, 12, 20 of a triangle
  std::vector<std::int32_t> order;
  std::vector<std::array<Vec3, 3>> leaf_corners;  ///< along `order`: side by side in memory for the search
  std::vector<Node> nodes;
};

}  // namespace impact
