// The paper's law of a pair (Fig. 1): elastic in compression, elastic then linearly softening in tension,
// modified Mohr-Coulomb in shear; a broken pair keeps friction only. Compression is positive.
//
// Beside it, by choice of the card, the law with moments: cohesion then weakens with the link's plastic slip,
// and rolling and twisting are resisted (moment_transfer.h). Everything else stays as it is.
//
// Parameters are stresses: a pair's forces are these times its interaction area S_int. With the normal modulus
// C = Kn D_init / S_int, which Eq. 1 makes the same for all pairs, the yield strain T/C is the same for all
// pairs too.
#pragma once
#include <cstddef>

#include "libdem/core/lanes.h"
#include "libdem/law/moment_transfer.h"
#include "libdem/law/pair_kinematics.h"
#include "libdem/material/material_card.h"

namespace dem {

struct LinkLaw {
  double normal_modulus = 0;    ///< C = Kn D_init / S_int [Pa]
  double shear_ratio = 0;       ///< Ks/Kn [-]
  double tensile_strength = 0;  ///< T [Pa]
  double cohesion = 0;          ///< Co [Pa]
  double softening = 1;         ///< zeta [-]
  double internal_slope = 0;    ///< tan phi_i
  double contact_slope = 0;     ///< tan phi_c
  SofteningUnloading unloading = SofteningUnloading::secant;
  CohesionDuringSoftening cohesion_during_softening = CohesionDuringSoftening::constant;
  BrokenLinkContact broken_link_contact = BrokenLinkContact::initial_distance;
  bool transfers_moments = false;  ///< the law with moments: the two below count
  double slip_softening = 0;  ///< zeta_s [-]: cohesion is gone at a slip of zeta_s Co S_int / Ks; 0: it stays
  MomentLaw moment;

  double yield_strain() const { return tensile_strength / normal_modulus; }
  double breaking_strain() const { return yield_strain() * (1 + softening); }
  bool is_broken(double max_strain) const { return max_strain >= breaking_strain(); }
  /// Plastic slip over D_init at which the cohesion is gone.
  double slip_strain() const { return slip_softening * cohesion / (shear_ratio * normal_modulus); }
  /// The named choices as a number, see choices_of.
  std::size_t choice() const {
    return (unloading == SofteningUnloading::elastic ? 1u : 0u) +
           (cohesion_during_softening == CohesionDuringSoftening::proportional ? 2u : 0u) +
           (broken_link_contact == BrokenLinkContact::radii ? 4u : 0u) + (transfers_moments ? 8u : 0u);
  }
};

/// The law of a card, its stiffness by Eq. 1. Throws InputError if the card is not valid.
LinkLaw make_link_law(const MaterialCard& card);

/// Energy that a link stores in its normal spring at `strain` [J]; `volume` is S_int * D_init [m3].
double stored_normal_energy(const LinkLaw& law, double strain, double max_strain, double volume);
/// Energy that a link has lost by softening [J]; T^2 S^2 (1 + zeta) / (2 Kn) once it is broken.
double softening_energy(const LinkLaw& law, double max_strain, double volume);

/// The named choices as a compile-time constant: the loop over pairs is chosen once, outside.
struct LinkChoices {
  bool elastic_unloading = false, proportional_cohesion = false, contact_at_radii = false,
       moment_transfer = false;
};
/// How many combinations there are, and the one of LinkLaw::choice() = `number`.
inline constexpr std::size_t link_choices = 16;
constexpr LinkChoices choices_of(std::size_t number) {
  return {(number & 1u) != 0, (number & 2u) != 0, (number & 4u) != 0, (number & 8u) != 0};
}

inline namespace SPALL_ISA {

/// The largest strain so far, kept once it has passed the yield strain (before that it has no effect), F_s, and
/// the plastic slip over D_init, which the law with moments keeps.
template <class Real>
struct PairHistory {
  Real max_strain, shear_x, shear_y, shear_z, slip;
};

/// Force on element a and its moment per unit arm: a gets (force, arm_a * moment), b gets (-force, arm_b *
/// moment).
template <class Real>
struct PairForce {
  Real fx, fy, fz, mx, my, mz;
  Real normal;   ///< F_n, compression positive [N]
  bool damaged;  ///< some link has passed its yield strain: only then does the history's largest strain change
};

/// One pair over one step. `radii` is Ra + Rb. Updates the history; `slid(work)` is called with what sliding
/// dissipated [J], if any pair slid. With the elements exchanged all vectors turn round and all bits stay.
template <LinkChoices choices, class Real, class Slid>
SPALL_INLINE PairForce<Real> evaluate(const LinkLaw& law, const PairKinematics<Real>& pair,
                                      Real inverse_initial_distance, Real area, Real radii, double time_step,
                                      PairHistory<Real>& history, Slid&& slid) {
  const Real zero = broadcast<Real>(0), one = broadcast<Real>(1);
  const Real strain = pair.distance * inverse_initial_distance - one;
  const Real stiffness = broadcast<Real>(law.normal_modulus) * area;  // Kn D_init [N]
  const Real largest = larger(history.max_strain, strain);

  Real normal = -stiffness * strain;  // F_n
  Real cohesion = broadcast<Real>(law.cohesion) * area;
  if constexpr (choices.moment_transfer) {
    const double weakening = law.slip_softening > 0 ? 1 / law.slip_strain() : 0;
    cohesion = cohesion * larger(zero, one - broadcast<Real>(weakening) * history.slip);
  }
  Real slope = broadcast<Real>(law.internal_slope);
  const double yield = law.tensile_strength / law.normal_modulus;
  PairForce<Real> force;
  force.damaged = any(largest > broadcast<Real>(yield));
  if (force.damaged) [[unlikely]] {
    const auto softened = largest > broadcast<Real>(yield);
    history.max_strain = select(softened, largest, history.max_strain);
    const Real fall = broadcast<Real>(law.normal_modulus / law.softening) * (largest - broadcast<Real>(yield));
    const Real remaining =
        larger(zero, broadcast<Real>(law.tensile_strength) - fall);  // tensile strength left [Pa]
    const auto broken = remaining <= zero;
    const auto apart = strain > zero;
    if constexpr (choices.elastic_unloading) {
      const Real unloaded = -(remaining - broadcast<Real>(law.normal_modulus) * (largest - strain)) * area;
      normal = select(softened, select(broken, select(apart, zero, normal), unloaded), normal);
    } else {
      const Real secant = -(remaining / largest) * strain * area;
      normal = select(softened, select(apart, secant, normal), normal);
    }
    if constexpr (choices.contact_at_radii) {
      const Real gap = pair.distance / radii - one;
      normal = select(broken, larger(zero, -stiffness * gap), normal);
    }
    if constexpr (choices.proportional_cohesion) {
      const Real left = remaining * broadcast<Real>(1 / law.tensile_strength);
      cohesion = select(softened, cohesion * left, cohesion);
    }
    cohesion = select(broken, zero, cohesion);
    slope = select(broken, broadcast<Real>(law.contact_slope), slope);
  }
  const Real limit = larger(zero, cohesion + normal * slope);

  // Carry the shear force with the pair: turn it about the normal, add the elastic increment, swing it into the
  // new tangent plane. Taking out its normal part along m (m.n = 1) instead of n keeps its length under
  // rotation.
  const Real shear_stiffness = broadcast<Real>(law.shear_ratio) * stiffness * inverse_initial_distance;  // K_s
  const Real step = shear_stiffness * broadcast<Real>(time_step);
  const Real ix = step * pair.sx, iy = step * pair.sy, iz = step * pair.sz;
  const Real turn = pair.half_turn;
  Real tx = history.shear_x + turn * (pair.my * history.shear_z - pair.mz * history.shear_y) + ix;
  Real ty = history.shear_y + turn * (pair.mz * history.shear_x - pair.mx * history.shear_z) + iy;
  Real tz = history.shear_z + turn * (pair.mx * history.shear_y - pair.my * history.shear_x) + iz;
  const Real out = tx * pair.nx + ty * pair.ny + tz * pair.nz;
  tx = tx - out * pair.mx, ty = ty - out * pair.my, tz = tz - out * pair.mz;

  const Real square = tx * tx + ty * ty + tz * tz;
  if (any(square > limit * limit)) [[unlikely]] {
    const auto slides = square > limit * limit;
    const Real keep = select(slides, limit / root(select(slides, square, one)), one);
    // Trapezoidal work of the mean shear force over the slip: what the ledger of an explicit step needs to
    // close.
    const Real mean = (one + keep) * square - (ix * tx + iy * ty + iz * tz);
    const Real spent = broadcast<Real>(0.5) * (one - keep) * mean / select(slides, shear_stiffness, one);
    slid(select(slides, spent, zero));
    if constexpr (choices.moment_transfer)
      history.slip = history.slip + select(slides & (cohesion > zero),
                                           (one - keep) * root(square) / select(slides, shear_stiffness, one) *
                                               inverse_initial_distance,
                                           zero);
    tx = tx * keep, ty = ty * keep, tz = tz * keep;
  }
  history.shear_x = tx, history.shear_y = ty, history.shear_z = tz;

  force.normal = normal;
  force.fx = tx - normal * pair.nx;
  force.fy = ty - normal * pair.ny;
  force.fz = tz - normal * pair.nz;
  force.mx = pair.ny * tz - pair.nz * ty;
  force.my = pair.nz * tx - pair.nx * tz;
  force.mz = pair.nx * ty - pair.ny * tx;
  return force;
}

}  // namespace SPALL_ISA
}  // namespace dem
