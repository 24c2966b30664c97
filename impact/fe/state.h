// The nodes in motion: plain columns, one row a node.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "impact/fe/body.h"

namespace fe {

/// Displacements at time t_n, velocities at t_(n-1/2) or t_(n+1/2) (Eq. 9 as leapfrog, staggered as libdem's).
struct State {
  std::vector<Vec3> displacement;  ///< u [m]
  std::vector<Vec3> velocity;      ///< [m/s]
  std::vector<Vec3> force;         ///< internal, -K u at t_n [N]
  std::vector<double> mass;        ///< [kg]
  std::vector<Vec3> inverse_mass;  ///< 1/mass; 0 where a degree of freedom is locked: it keeps its velocity

  explicit State(const Body& body);
  std::size_t nodes() const { return mass.size(); }

  /// Makes degree of freedom `axis` (0, 1, 2) of these nodes keep the velocity `velocity` [m/s], 0: a support.
  void lock(std::span<const std::int32_t> nodes, int axis, double velocity = 0);
};

/// 1/2 m v.v of the velocities as they are, at t_(n+1/2) [J].
double kinetic_energy(const State& state);
/// 1/2 u K u [J]; needs state.force to belong to state.displacement.
double elastic_energy(const State& state);
/// [kg m/s]
Vec3 momentum(const State& state);

}  // namespace fe
