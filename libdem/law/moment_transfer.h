// Moments that a pair transfers beside its forces: rolling (bending of the link) and twisting, each elastic up
// to a limit that is proportional to the pair's compression, so that they vanish in tension. After the rolling
// law of Omar, Marin and Daudeville; the paper's own law lets elements roll freely.
//
// Stiffness and limit follow the pair's geometry: with R = min(Ra, Rb) and the normal stiffness Kn, a moment
// has the stiffness k Kn R^2 [N m/rad] and the limit eta R F_n [N m].
#pragma once
#include "libdem/core/lanes.h"
#include "libdem/law/pair_kinematics.h"

namespace dem {

/// All four are numbers without unit.
struct MomentLaw {
  double rolling_stiffness = 0;   ///< k_r: rolling stiffness over Kn R^2
  double rolling_limit = 0;       ///< eta_r: largest rolling moment over R F_n
  double twisting_stiffness = 0;  ///< k_t
  double twisting_limit = 0;      ///< eta_t
};

inline namespace SPALL_ISA {

template <class Real>
struct MomentHistory {
  Real x, y, z;  ///< rolling moment on element a, normal to the link [N m]
  Real twist;    ///< twisting moment on element a, about the normal [N m]
};

/// The moment on element a; b gets its opposite [N m].
template <class Real>
struct PairMoment {
  Real x, y, z;
};

/// One pair over one step. `area` is S_int and `normal` F_n, compression positive [N]. Updates the history;
/// `slid(work)` is called with what yielding dissipated [J], if any pair yielded. With the elements exchanged
/// the moment turns round and all bits stay.
template <class Real, class Slid>
SPALL_INLINE PairMoment<Real> transfer_moment(const MomentLaw& law, double normal_modulus,
                                              const PairElement<Real>& a, const PairElement<Real>& b,
                                              const PairKinematics<Real>& pair, Real inverse_initial_distance,
                                              Real area, Real normal, double time_step,
                                              MomentHistory<Real>& history, Slid&& slid) {
  const Real zero = broadcast<Real>(0), one = broadcast<Real>(1), half = broadcast<Real>(0.5);
  const Real radius = smaller(a.radius, b.radius);
  const Real unit = broadcast<Real>(normal_modulus) * area * inverse_initial_distance * radius * radius;
  const Real push = radius * larger(zero, normal);

  // How b turns on a during the step, along the mid-step normal and across it.
  const Real step = broadcast<Real>(time_step);
  const Real dx = step * (b.wx - a.wx), dy = step * (b.wy - a.wy), dz = step * (b.wz - a.wz);
  const Real along = dx * pair.mx + dy * pair.my + dz * pair.mz;

  // The rolling moment is carried with the pair as the shear force is (see `evaluate`).
  const Real rolling = broadcast<Real>(law.rolling_stiffness) * unit;
  const Real ix = rolling * (dx - along * pair.mx), iy = rolling * (dy - along * pair.my),
             iz = rolling * (dz - along * pair.mz);
  const Real turn = pair.half_turn;
  Real x = history.x + turn * (pair.my * history.z - pair.mz * history.y) + ix;
  Real y = history.y + turn * (pair.mz * history.x - pair.mx * history.z) + iy;
  Real z = history.z + turn * (pair.mx * history.y - pair.my * history.x) + iz;
  const Real out = x * pair.nx + y * pair.ny + z * pair.nz;
  x = x - out * pair.mx, y = y - out * pair.my, z = z - out * pair.mz;
  const Real limit = broadcast<Real>(law.rolling_limit) * push;
  const Real square = x * x + y * y + z * z;
  if (any(square > limit * limit)) [[unlikely]] {
    const auto yields = square > limit * limit;
    const Real keep = select(yields, limit / root(select(yields, square, one)), one);
    const Real mean = (one + keep) * square - (ix * x + iy * y + iz * z);  // trapezoidal work, as of sliding
    slid(select(yields, half * (one - keep) * mean / select(yields, rolling, one), zero));
    x = x * keep, y = y * keep, z = z * keep;
  }
  history.x = x, history.y = y, history.z = z;

  const Real twisting = broadcast<Real>(law.twisting_stiffness) * unit;
  const Real increment = twisting * along;
  Real twist = history.twist + increment;
  const Real twist_limit = broadcast<Real>(law.twisting_limit) * push;
  if (any(twist * twist > twist_limit * twist_limit)) [[unlikely]] {
    const auto yields = twist * twist > twist_limit * twist_limit;
    const Real kept = select(twist > zero, twist_limit, -twist_limit);
    const Real mean = twist + kept - increment;
    slid(select(yields, half * (twist - kept) * mean / select(yields, twisting, one), zero));
    twist = select(yields, kept, twist);
  }
  history.twist = twist;
  return {x + twist * pair.nx, y + twist * pair.ny, z + twist * pair.nz};
}

}  // namespace SPALL_ISA
}  // namespace dem
