// Finite elements need fewer steps than discrete ones: far from the overlap, their internal force is computed
// every m-th step only.
#pragma once
#include <cstdint>

#include "impact/coupling/kinematic_map.h"
#include "impact/fe/motion.h"

namespace coupling {

/// The largest m with m * time_step at most `share` of the finite elements' critical step, 1 or more. Throws
/// InputError if even m = 1 is too long.
int largest_interval(double time_step, double critical_time_step, double share = 0.9);

/// Which finite elements are computed at every step, which at every m-th.
///
/// Every m-th step the force of the far elements is applied as the impulse of all m, m * dt * F: the only rule
/// that is stable up to the finite elements' own critical step; a force held over the m steps diverges.
/// Elements that touch a tied node go with every step: discrete elements vibrate faster than 1/(m dt), and an
/// impulse every m steps on what is tied to them would feed those vibrations, slowly but for ever.
class SubStepping {
 public:
  SubStepping(const fe::Body& body, const KinematicMap& map, int interval);

  /// Velocities of the finite elements over step number `step`, for displacements at its beginning. Leaves in
  /// state.force what acted, the mean over the step: locked nodes pass time_step * force on to their supports.
  void advance_velocities(const fe::Body& body, fe::State& state, std::int64_t step, double time_step,
                          int threads = 1);

  int interval() const { return every; }
  std::size_t near_elements() const { return near.elements.size(); }

 private:
  int every = 1;
  fe::Portion near, far;
  fe::ElementRows room;
};

}  // namespace coupling
