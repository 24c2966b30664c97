// Equilibrium of the link network: conjugate gradients with one 6x6 block an element as preconditioner. Elastic
// tests need no time steps.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/statics/link_network.h"

namespace dem {

struct StaticSolution {
  std::vector<double> displacement;  ///< 6 per element [m, rad]
  std::vector<double> force;         ///< K u: reactions where a degree of freedom is held, 0 elsewhere [N, N m]
  int iterations = 0;
};

/// Solves K u = 0 on the free degrees of freedom. `displacement` holds the prescribed values where `held` is 1
/// and the first guess elsewhere; both have 6 * elements entries. Elements with fewer than three links move
/// with their first guess. Stops when the residual is below `tolerance` times the reaction norm. Throws
/// RunError if it does not converge.
StaticSolution solve_static(const LinkNetwork& network, std::vector<std::uint8_t> held,
                            std::vector<double> displacement, double tolerance = 1e-8);

}  // namespace dem
