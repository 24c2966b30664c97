// The discrete elements as the coupling sees them.
#pragma once
#include "impact/coupling/multipliers.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace coupling {

/// Gives every element its weight b, of mass and inertia, and every pair the smaller weight of its two, of
/// stiffness, strength and stored energy. Once, before the first step.
void weigh(const Zone& zone, dem::Particles& particles, dem::Links& links);

/// Masses of the tied elements as they are, weighted; 0 where a motion is prescribed.
DiscreteMasses tied_masses(const KinematicMap& map, const dem::Particles& particles);

/// Where Multipliers::apply finds and changes the velocities. Whoever applies it raises StepRoom::max_speed to
/// the root of TieSums::max_speed_squared.
DiscreteVelocities velocities(dem::Particles& particles);

}  // namespace coupling
