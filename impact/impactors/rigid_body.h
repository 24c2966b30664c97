// A rigid body with six degrees of freedom, moved by the same leapfrog as the elements (Eq. 9): pose at t_n,
// velocity and angular momentum at t_(n+1/2).
#pragma once
#include <array>

#include "impact/impactors/mass_properties.h"
#include "libdem/core/vector.h"

namespace impact {

/// What does not change.
struct RigidBody {
  double mass = 0;              ///< [kg]
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass, in the body's frame [kg m2]
  Mat3 inverse_inertia = Mat3::Zero();
  /// Degrees of freedom that keep their velocity whatever pushes: displacements along, then rotations about,
  /// the axes of space.
  std::array<bool, 6> locked{};

  bool keeps_velocity(int axis) const { return locked[static_cast<std::size_t>(axis)]; }
  bool keeps_spin(int axis) const { return locked[3 + static_cast<std::size_t>(axis)]; }

  RigidBody() = default;
  /// Throws InputError that names `where` if the mass or a principal inertia is not positive and finite.
  RigidBody(const MassProperties& properties, const std::array<bool, 6>& locked_freedoms,
            const std::string& where);
};

/// What a checkpoint must keep of the motion.
struct Motion {
  Vec3 position = Vec3::Zero();                                     ///< of the centre of mass, at t_n [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< from the body's frame to space, at t_n
  Vec3 velocity = Vec3::Zero();                                     ///< at t_(n+1/2) [m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the centre of mass, in space, at t_(n+1/2) [kg m2/s]
  Vec3 spin = Vec3::Zero();              ///< angular velocity at t_(n+1/2); kept where locked [rad/s]
  // What whoever locks degrees of freedom has given since the start.
  Vec3 support_impulse = Vec3::Zero();          ///< [N s]
  Vec3 support_angular_impulse = Vec3::Zero();  ///< about the centre of mass of the moment [N m s]
  double support_work = 0;                      ///< [J]
};

/// At rest in `orientation`, then moving. `spin` is in space.
Motion start_motion(const RigidBody& body, const Vec3& position, const Eigen::Quaterniond& orientation,
                    const Vec3& velocity, const Vec3& spin);

/// Position and orientation at one time.
struct Pose {
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Vec3 to_body(const Vec3& point) const { return orientation.conjugate() * (point - position); }
  Vec3 to_space(const Vec3& local) const { return position + orientation * local; }
};
inline Pose pose_of(const Motion& motion) { return {motion.position, motion.orientation}; }

/// Moves the body to t_(n+1) and returns its pose half way. The spin is the one that the angular momentum has
/// in the orientation half way (the implicit midpoint rule): angular momentum is kept to rounding, energy
/// swings by O(dt^2) without drift, the gyroscopic term is in it. Throws RunError if the body turns so far in
/// one step that this cannot be solved.
Pose drift(const RigidBody& body, Motion& motion, double time_step);

/// Changes velocity and angular momentum by what acts at t_(n+1): force [N], moment about the centre of mass
/// [N m]. Returns the kinetic energy at t_(n+1) [J] as the elements' ledger takes it, 1/2 v- m v+.
double kick(const RigidBody& body, Motion& motion, const Vec3& force, const Vec3& moment, double time_step);

}  // namespace impact
