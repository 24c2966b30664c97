// The energy ledger: where the work of the platens went.
#pragma once
#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// All in joules. external + initial = kinetic + elastic + softening + sliding + damping, up to the scheme's
/// error.
struct EnergyLedger {
  double external = 0;  ///< work of the platens and supports
  double initial = 0;   ///< kinetic energy at the start
  double kinetic = 0;
  double elastic = 0;    ///< stored in the normal and shear springs, and in those of moments
  double softening = 0;  ///< dissipated by links that soften and break
  double sliding =
      0;  ///< dissipated by shear that slides and moments that yield, and by what a break releases of them
  double damping = 0;  ///< dissipated by local damping

  double imbalance() const { return external + initial - (kinetic + elastic + softening + sliding + damping); }
};

/// Elastic energy and softening dissipation of all pairs: functions of the state, nothing is accumulated.
struct PairEnergy {
  double elastic = 0, softening = 0;
};
PairEnergy pair_energy(const LinkLaw& law, const Particles& particles, const Links& links);

}  // namespace dem
