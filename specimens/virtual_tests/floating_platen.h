// A platen that is not driven but pressed: one rigid body of the elements that it holds.
#pragma once
#include <cstdint>
#include <span>

#include "libdem/state/particles.h"

namespace virtual_tests {

/// Gives the elements, whose degree of freedom `axis` is prescribed, their common velocity after a step in
/// which the specimen pushed them with what is in particles.force and `applied` acted along the axis [N]. Local
/// damping as the other elements have it; `slow` is the velocity above which it acts fully [m/s].
void move_floating(dem::Particles& particles, std::span<const std::int32_t> elements, int axis, double applied,
                   double time_step, double damping, double slow);

}  // namespace virtual_tests
