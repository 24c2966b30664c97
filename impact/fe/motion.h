// The phases of one explicit step of the finite elements (central difference, Eq. 9, as leapfrog).
#pragma once
#include <vector>

#include "impact/fe/state.h"

namespace fe {

/// Room for what the elements do to their nodes, made anew at will: 24 forces an element [N].
struct ElementRows {
  dem::Column<double> rows;
};

/// displacement += time_step * velocity.
void advance_positions(State& state, double time_step, int threads = 1);

/// force = -K displacement, element by element, summed at each node in the order of its elements: the same bits
/// on any number of threads.
void internal_force(const Body& body, State& state, ElementRows& room, int threads = 1);

/// force -= factor * K displacement of some elements only, on the nodes that they touch.
void add_internal_force(const Body& body, const Portion& portion, double factor, State& state,
                        ElementRows& room, int threads = 1);

/// velocity += duration * force / mass; `duration` is the time step.
void advance_velocities(State& state, double duration, int threads = 1);

}  // namespace fe
