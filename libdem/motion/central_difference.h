// The explicit central difference scheme (Eq. 9), as leapfrog: positions at t_n, velocities at t_(n+1/2).
#pragma once

namespace dem {

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

}  // namespace dem
