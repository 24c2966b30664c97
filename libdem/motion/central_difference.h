// The explicit central difference scheme (Eq. 9), as leapfrog: positions at t_n, velocities at t_(n+1/2).
#pragma once
#include "libdem/force/pair_forces.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Elements whose sums go together; fixed, see pairs_per_block.
inline constexpr std::size_t elements_per_block = 256;

/// Local (Cundall) damping: factor 0 to 1 and the velocities above which it acts fully.
struct LocalDamping {
  double factor = 0;
  double reference_velocity = 1e-5;  ///< [m/s]
  double reference_spin = 1e-3;      ///< [rad/s]
};

struct MotionSums {
  double damped = 0;   ///< dissipated by damping in this step [J]
  double kinetic = 0;  ///< kinetic energy at t_n, 1/2 m v(n-1/2).v(n+1/2): exact for a linear leapfrog [J]
  double max_speed_squared = 0;  ///< [m2/s2]
};

/// Sums the pairs' forces on every element, then advances its velocities by one step (Eq. 9).
MotionSums advance_velocities(Particles& particles, const PairRows& link_rows, const Incidence& link_incidence,
                              const PairRows* contact_rows, const Incidence* contact_incidence,
                              double time_step, const LocalDamping& damping, int threads);

/// Advances positions and rotations by one step (Eq. 9).
void advance_positions(Particles& particles, double time_step, int threads);

}  // namespace dem
