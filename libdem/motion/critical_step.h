// The largest stable time step of the explicit scheme, computed from the network's highest frequency.
#pragma once
#include "libdem/state/particles.h"
#include "libdem/statics/link_network.h"

namespace dem {

/// 2 / omega_max of the undamaged network [s]: omega_max^2 is the largest eigenvalue of M^-1 K, by Lanczos from
/// a fixed start. Softening only lowers it; new contacts raise it a little, so runs use a fraction of it.
double critical_time_step(const LinkNetwork& network, const Particles& particles);

}  // namespace dem
