// Finite elements need fewer steps than discrete ones: far from the overlap, their internal force is computed
// every m-th step only.
#pragma once
#include <cstdint>
#include <span>

#include "impact/coupling/kinematic_map.h"
#include "impact/fe/motion.h"

namespace coupling {

/// The largest m with m * time_step at most `share` of the finite elements' critical step, 1 or more. Throws
/// InputError if even m = 1 is too long.
int largest_interval(double time_step, double critical_time_step, double share = 0.9);

/// What impulses every m-th step add to the energies that a ledger reads, 1/2 v(-) M v(+) and 1/2 u K u at the
/// time of an impulse, so that the sum stays what it is: [J].
struct ImpulseEnergy {
  double kinetic = 0, elastic = 0;
};

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

  /// For displacements at a step that applied the impulse, a multiple of m, with the velocities before and
  /// after it.
  ///
  /// Of a vibration at w the ledger misses w^2 (m dt)^2/6 where elements go with every m-th step, next to
  /// nothing where they go with every one: a wave that passes from one to the other would change the sum. To
  /// second order in T = m dt, and with f the far elements' forces and g all others', what is missing is (the
  /// modified energy of the splitting)
  ///   T^2/12 v(-) K_far v(+)  +  T^2/12 f.f/M  -  (T^2/12 - T dt/4) f.g/M.
  ImpulseEnergy impulse_energy(const fe::Body& body, const fe::State& state,
                               std::span<const Vec3> velocity_before, double time_step) const;

  int interval() const { return every; }
  std::size_t near_elements() const { return near.elements.size(); }

 private:
  int every = 1;
  fe::Portion near, far;
  fe::ElementRows room;
};

}  // namespace coupling
