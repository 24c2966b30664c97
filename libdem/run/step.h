// One time step, its phases in order.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libdem/force/contact_forces.h"
#include "libdem/force/link_blocks.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/motion/central_difference.h"
#include "libdem/run/block_loop.h"
#include "libdem/search/contact_detector.h"
#include "libdem/state/element_load.h"
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

/// SHA-256 over positions, rotations, velocities and the pairs' histories (settled): two runs agree bit for bit
/// or not.
std::string state_sha256(const Assembly& assembly);

/// Room that a run works in; it can be made anew from the assembly at any step.
struct StepRoom {
  LinkBlocks link_blocks;  ///< holds the links' histories while the run goes on, see settle
  Incidence contact_incidence;
  ContactRows contact_rows;
  ContactDetector detector;
  BlockLoops loops;            ///< compiled for this machine's instructions
  double smallest_radius = 0;  ///< of all elements [m]
  double max_speed = 0;        ///< of the last step [m/s]; raise it when velocities are changed between steps
  Column<Kinematics> next;     ///< what the step under way makes of the kinematics
  std::vector<Column<SixRow>> sums;                       ///< a block's forces, one for each thread
  std::vector<std::pair<double, MotionSums>> block_sums;  ///< dissipated by sliding [J]; of the motion

  /// Gives the assembly's pairs the columns that its law needs, if they lack them.
  explicit StepRoom(Assembly& assembly);
};

/// Brings the histories that the room holds back into assembly.links: call it before reading them.
void settle(Assembly& assembly, const StepRoom& room);

struct StepOptions {
  double time_step = 0;  ///< [s]
  LocalDamping damping;
  int threads = 1;
  /// Fill Particles::force for every element; otherwise only where a degree of freedom is prescribed.
  bool all_forces = false;
};

/// What the ledger gets from one step [J].
struct StepSums {
  double sliding = 0, damped = 0, kinetic = 0;
};

/// Contacts found and evaluated, then block by block: positions to t_n, links evaluated, forces summed,
/// velocities to t_(n+1/2) (Eq. 9). `loads` act at t_n besides the pairs, sorted by element.
StepSums advance(Assembly& assembly, StepRoom& room, const StepOptions& options,
                 std::span<const ElementLoad> loads = {});

}  // namespace dem
