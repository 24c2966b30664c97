// What the finite elements say about the motion of each overlapped discrete element (Eqs. 6 and 7).
#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "impact/coupling/zone.h"

namespace coupling {

/// Which motions of the overlapped discrete elements follow the finite elements.
enum class Ties {
  displacements,               ///< Eq. 6
  displacements_and_rotations  ///< Eq. 7; costs more than twice as much and changes little
};

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// d = k u, and omega = h u where rotations are tied. Built once, on the initial positions.
struct KinematicMap {
  Ties ties = Ties::displacements;
  std::vector<std::int32_t> elements;  ///< tied discrete elements, by the finite element that holds them
  std::vector<std::int32_t> nodes;     ///< finite-element nodes that they follow, ascending
  RowMatrix k;  ///< elements x nodes: shape functions at the centres; every row sums to 1 [-]
  RowMatrix h;  ///< 3 elements x 3 nodes: half the curl there [1/m]; empty unless rotations are tied
  /// Finite elements that hold tied elements ("cells"): rows cell_first[c] to cell_first[c + 1] of k lie in
  /// cell c, whose eight nodes are columns 8 c to 8 c + 7 of cell_nodes; `shape` has those eight entries of k,
  /// row by row.
  std::vector<std::int32_t> cell_first, cell_nodes;
  std::vector<double> shape;
};

/// Ties every element whose centre has an overlap coordinate above 0. Throws InputError if one of them lies in
/// no finite element, if nothing is tied, if a coupled face has no finite elements behind it, or if there are
/// some where discrete elements should be alone.
KinematicMap make_kinematic_map(const Zone& zone, const fe::Mesh& mesh, const fe::Body& body,
                                std::span<const Vec3> centres, Ties ties = Ties::displacements);

}  // namespace coupling
