// A mesh of eight-node hexahedra: where the nodes are, which eight make an element.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "libdem/core/vector.h"

namespace fe {
using dem::Mat3;
using dem::Vec3;

/// The eight node numbers of an element, in VTK's and Gmsh's order: the face at the third local coordinate -1,
/// counter-clockwise seen from inside, then the opposite face.
using Hexahedron = std::array<std::int32_t, 8>;
/// The corners of one element, a row each [m].
using Corners = Eigen::Matrix<double, 8, 3>;

struct Mesh {
  std::string origin;       ///< in words, or the file's name: errors begin with it
  std::vector<Vec3> nodes;  ///< [m]
  std::vector<Hexahedron> elements;
  std::map<std::string, std::vector<std::int32_t>> groups;  ///< node numbers, ascending, by the group's name
  std::vector<std::size_t> element_tags;  ///< the file's own number of each element; empty: counted from 0
  std::vector<std::size_t> node_tags;     ///< the same of each node

  Corners corners(std::size_t element) const;
  Vec3 centre(std::size_t element) const;
  std::size_t element_tag(std::size_t element) const;
  std::size_t node_tag(std::size_t node) const;
};

/// Refuses what cannot be computed with: no element, coordinates that are no numbers, node numbers out of
/// range, inverted or degenerate elements, nodes that belong to no element, two nodes at one place. Throws
/// InputError that names the mesh's origin and the first offender.
void check(const Mesh& mesh);

/// The shortest edge of all elements [m].
double shortest_edge(const Mesh& mesh);

/// Nodes inside the box [low, high], borders included to 1e-9 of the box's diagonal; ascending.
std::vector<std::int32_t> nodes_in_box(const Mesh& mesh, const Vec3& low, const Vec3& high);

}  // namespace fe
