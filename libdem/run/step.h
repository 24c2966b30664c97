// One time step, its phases in order.
#pragma once
#include <string>

#include "libdem/force/pair_forces.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/motion/central_difference.h"
#include "libdem/search/contact_detector.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// What a run is about: elements, pairs, the law between them. Everything that a checkpoint must keep.
struct Assembly {
  Particles particles;
  Links links;     ///< linked at the start
  Links contacts;  ///< pairs that came together since
  LinkLaw law;
};

/// SHA-256 over positions, rotations, velocities and the pairs' histories: two runs agree bit for bit or not.
std::string state_sha256(const Assembly& assembly);

/// Room that a run works in; it can be made anew from the assembly at any step.
struct StepRoom {
  Incidence link_incidence, contact_incidence;
  PairRows link_rows, contact_rows;
  ContactDetector detector;
  double max_speed = 0;  ///< of the last step [m/s]

  explicit StepRoom(const Assembly& assembly)
      : link_incidence(assembly.links, assembly.particles.count),
        detector(assembly.particles, assembly.links) {}
};

struct StepOptions {
  double time_step = 0;  ///< [s]
  LocalDamping damping;
  int threads = 1;
};

/// What the ledger gets from one step [J].
struct StepSums {
  double sliding = 0, damped = 0, kinetic = 0;
};

/// Positions to t_n, contacts found, pairs evaluated, forces summed, velocities to t_(n+1/2) (Eq. 9).
StepSums advance(Assembly& assembly, StepRoom& room, const StepOptions& options);

}  // namespace dem
