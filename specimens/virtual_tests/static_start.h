// A start without a shock: every element moves at once as the elastic solution wants it.
#pragma once
#include "libdem/run/step.h"
#include "libdem/statics/link_network.h"

namespace virtual_tests {

/// Gives every degree of freedom that is not prescribed the velocity that it has in the elastic solution for
/// the prescribed ones, and writes into particles.force the resultants that go with that solution per second
/// of motion [N/s, N m/s]. Where the prescribed motion leaves the body free to move as a whole, it does not.
/// Throws RunError if the solver does not converge.
void start_as_elastic(dem::Particles& particles, const dem::LinkNetwork& network);

}  // namespace virtual_tests
