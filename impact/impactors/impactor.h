// An impactor: a rigid body of some shape that pushes elements, and is pushed by them.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "impact/impactors/contact_law.h"
#include "impact/impactors/rigid_body.h"
#include "impact/impactors/shape.h"
#include "libdem/state/element_load.h"
#include "libdem/state/particles.h"

namespace impact {

/// What does not change.
struct Impactor {
  Shape shape;
  RigidBody body;
  ContactLaw law;
};

/// Everything that a checkpoint must keep.
struct ImpactorState {
  Motion motion;
  std::vector<ContactHistory> contacts;  ///< sorted by element
};

/// The state as named columns of numbers, and back, bit for bit. Reading throws InputError that names `where`
/// if a column is missing or of another length.
std::map<std::string, std::vector<double>> to_numbers(const ImpactorState& state);
ImpactorState from_numbers(const std::map<std::string, std::vector<double>>& numbers, const std::string& where);

/// Which elements may be near. Can be made anew at any step; what comes out does not depend on when it was.
struct ImpactorRoom {
  struct Candidate {
    std::int32_t element = 0;
    double far_until = 0;  ///< cannot touch before `travel` reaches this [m]
  };
  std::vector<Candidate> candidates;  ///< sorted by element
  double travel = 0;  ///< a bound of all motion between impactor and elements since the list [m]
  double skin = 0;    ///< the list holds for so much travel [m]; 0: not made yet
  double reach = 0;   ///< from the centre of mass to the farthest corner of the bounding box [m]
  std::size_t rebuilds = 0, looked_at = 0;  ///< lists made, distances computed since the start
};

struct ImpactorStep {
  double time_step = 0;  ///< [s]
  double max_speed = 0;  ///< no element is faster [m/s]; dem::StepRoom knows it
  Vec3 other_force =
      Vec3::Zero();  ///< on the impactor besides the elements', at its centre of mass: its weight [N]
};

/// What happened in a step, at t_(n+1) or up to it.
struct ImpactorSums {
  Vec3 force = Vec3::Zero();   ///< of the elements on the impactor [N]
  Vec3 moment = Vec3::Zero();  ///< the same about the impactor's centre of mass [N m]
  double kinetic = 0;          ///< of the impactor, 1/2 v- m v+ [J]
  double stored = 0;           ///< in the contacts' springs [J]
  double sliding = 0;          ///< dissipated by friction in this step [J]
  double damped = 0;           ///< dissipated by dashpots in this step [J]
  double deepest_overlap = 0;  ///< [m]
  std::size_t touching = 0;    ///< elements in contact
};

/// One step. Before it, elements and impactor have their positions at t_n and velocities at t_(n+1/2); after it
/// the impactor has moved to t_(n+1) and has its velocity at t_(n+3/2), and `loads` holds the forces on the
/// elements at t_(n+1), sorted by element, ready for the elements' own step, which moves them there. The
/// impactor gets the negated forces and their moments at the same points, so the momentum of both together is
/// kept to rounding. Serial: the same bits on any number of threads.
ImpactorSums advance_impactor(const Impactor& impactor, ImpactorState& state, ImpactorRoom& room,
                              const dem::Particles& particles, const ImpactorStep& step,
                              std::vector<dem::ElementLoad>& loads);

/// The smallest distance between the impactor's surface and an element's; negative if they overlap [m].
/// `element` is -1 if there are no elements.
struct Gap {
  double gap = 0;
  std::int32_t element = -1;
};
Gap nearest_gap(const Shape& shape, const Pose& pose, const dem::Particles& particles);

/// How far the impactor can be moved along `direction` (a unit vector) until it touches an element, to within
/// 1e-9 of its size [m]; 0 if it touches now, nothing if it never does. Throws RunError if it would have to
/// graze the elements too closely to tell.
std::optional<double> distance_to_contact(const Shape& shape, const Pose& pose, const Vec3& direction,
                                          const dem::Particles& particles);

/// The square of the highest frequency that contacts can add to elements of this size [1/s2]; the elements'
/// network and the contacts together stay below the sum of both squares. The share of the impactor's own mass
/// is left out, it must be heavy against the elements. Hertz: at an overlap of a tenth of the radius.
double contact_frequency_squared(const ContactLaw& law, double radius, double mass, double inertia);

}  // namespace impact
