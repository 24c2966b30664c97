// Equilibrium of the finite elements: sparse Cholesky, no time steps.
#pragma once
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "impact/fe/body.h"

namespace fe {

/// K, symmetric, both halves, 3 * nodes [N/m].
Eigen::SparseMatrix<double> assemble(const Body& body);

struct StaticSolution {
  std::vector<Vec3> displacement;  ///< [m]
  std::vector<Vec3> reaction;  ///< K u - load: what holds the held degrees of freedom, about 0 elsewhere [N]
};

/// Which degrees of freedom of a node are held.
using Held = std::array<bool, 3>;

/// Solves K u = load on the free degrees of freedom; `prescribed` holds u where `held` says so. All by node.
/// Throws RunError if the supports leave a motion free.
StaticSolution solve_static(const Body& body, std::span<const Vec3> load, std::span<const Held> held,
                            std::span<const Vec3> prescribed);

}  // namespace fe
