// The largest stable time step of the finite elements, and their highest frequency.
#pragma once
#include "impact/fe/body.h"

namespace fe {

/// 2 / omega_max [s], with omega_max^2 bounded from above by the highest eigenvalue of any single element on
/// its own mass (Irons, Treharne): always safe; on an even mesh a fifth short of the largest stable step, on a
/// distorted one up to a third.
double critical_time_step(const Body& body);

/// omega_max of all nodes together [rad/s], nothing locked: the root of the largest eigenvalue of M^-1 K, by
/// Lanczos from a fixed start, from below to a relative 1e-4.
double highest_frequency(const Body& body);

}  // namespace fe
