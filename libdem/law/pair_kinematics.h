// Where two elements meet and how they move past each other there (Eq. 2), in lanes.
#pragma once
#include "libdem/core/lanes.h"

namespace dem {
inline namespace SPALL_ISA {

/// One element of a pair, see Kinematics.
template <class Real>
struct PairElement {
  Real x, y, z, radius, vx, vy, vz, wx, wy, wz, weight;
};

/// S_int = pi min(Ra, Rb)^2 [m2], times the smaller of the elements' weights.
template <class Real>
SPALL_INLINE Real interaction_area(const PairElement<Real>& a, const PairElement<Real>& b) {
  const Real radius = smaller(a.radius, b.radius);
  return broadcast<Real>(3.141592653589793) * (radius * radius) * smaller(a.weight, b.weight);
}

template <class Real>
struct PairKinematics {
  Real distance;      ///< D^(a,b) [m]
  Real nx, ny, nz;    ///< unit normal from a to b at t_n
  Real mx, my, mz;    ///< normal at mid-step t_(n-1/2), scaled so that m.n = 1
  Real arm_a, arm_b;  ///< from each centroid to the equivalent contact point P_c (Eq. 2) [m]
  Real sx, sy, sz;    ///< sliding velocity of b past a at P_c, normal to m [m/s]
  Real half_turn;     ///< rotation of the pair about its own normal during the step [rad]
};

/// Velocities belong to the mid-step, so tangential motion is measured against the mid-step normal: measured
/// against the normal at t_n a rigid rotation would leave spurious shear.
///
/// Seen from b, with the elements exchanged, every vector turns round and every bit of its length stays: no sum
/// of the two elements' terms may be fused into one rounding on one side only (`rounded`).
template <class Real>
SPALL_INLINE PairKinematics<Real> pair_kinematics(const PairElement<Real>& a, const PairElement<Real>& b,
                                                  double time_step) {
  PairKinematics<Real> k;
  const Real half_step = broadcast<Real>(0.5 * time_step);
  const Real dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  k.distance = root(dx * dx + dy * dy + dz * dz);
  const Real inverse = broadcast<Real>(1) / k.distance;
  k.nx = dx * inverse, k.ny = dy * inverse, k.nz = dz * inverse;
  k.arm_a = broadcast<Real>(0.5) * (k.distance + (a.radius - b.radius));
  k.arm_b = broadcast<Real>(0.5) * (k.distance - (a.radius - b.radius));

  const Real ux = b.vx - a.vx, uy = b.vy - a.vy, uz = b.vz - a.vz;
  const Real un = ux * k.nx + uy * k.ny + uz * k.nz;
  const Real back = half_step * inverse;
  k.mx = k.nx - back * (ux - un * k.nx);
  k.my = k.ny - back * (uy - un * k.ny);
  k.mz = k.nz - back * (uz - un * k.nz);

  const Real px = rounded(k.arm_a * a.wx) + rounded(k.arm_b * b.wx);
  const Real py = rounded(k.arm_a * a.wy) + rounded(k.arm_b * b.wy);
  const Real pz = rounded(k.arm_a * a.wz) + rounded(k.arm_b * b.wz);
  const Real rx = ux - (py * k.mz - pz * k.my);
  const Real ry = uy - (pz * k.mx - px * k.mz);
  const Real rz = uz - (px * k.my - py * k.mx);
  const Real rn = rx * k.mx + ry * k.my + rz * k.mz;
  k.sx = rx - rn * k.mx, k.sy = ry - rn * k.my, k.sz = rz - rn * k.mz;
  k.half_turn = half_step * ((a.wx + b.wx) * k.mx + (a.wy + b.wy) * k.my + (a.wz + b.wz) * k.mz);
  return k;
}

}  // namespace SPALL_ISA
}  // namespace dem
