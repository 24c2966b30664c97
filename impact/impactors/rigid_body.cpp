#include "impact/impactors/rigid_body.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "libdem/core/error.h"

namespace impact {
namespace {

/// The rotation by |angle| about angle.
Eigen::Quaterniond turned_by(const Vec3& angle) {
  const double half = 0.5 * angle.norm();
  // The series where the quotient nears 0/0.
  const double factor = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;
  const Vec3 part = 0.5 * factor * angle;
  return {std::cos(half), part.x(), part.y(), part.z()};
}

bool any_rotation_locked(const RigidBody& body) {
  return body.keeps_spin(0) || body.keeps_spin(1) || body.keeps_spin(2);
}

/// The spin that belongs to the free parts of the angular momentum and the locked parts of `spin`.
Vec3 spin_of(const RigidBody& body, const Eigen::Quaterniond& orientation, const Vec3& angular_momentum,
             const Vec3& spin) {
  const Mat3 turn = orientation.toRotationMatrix();
  if (!any_rotation_locked(body)) return turn * (body.inverse_inertia * (turn.transpose() * angular_momentum));
  Mat3 rows = turn * body.inertia * turn.transpose();
  Vec3 right = angular_momentum;
  // A locked row says "spin = kept"; scaled like the others, which are inertias.
  const double scale = body.inertia.trace();
  for (int k = 0; k < 3; ++k)
    if (body.keeps_spin(k)) {
      rows.row(k) = scale * Vec3::Unit(k).transpose();
      right[k] = scale * spin[k];
    }
  Vec3 result = rows.fullPivLu().solve(right);
  for (int k = 0; k < 3; ++k)
    if (body.keeps_spin(k)) result[k] = spin[k];
  return result;
}

Vec3 inertia_times(const RigidBody& body, const Eigen::Quaterniond& orientation, const Vec3& spin) {
  return orientation * (body.inertia * (orientation.conjugate() * spin));
}

}  // namespace

RigidBody::RigidBody(const MassProperties& properties, const std::array<bool, 6>& locked_freedoms,
                     const std::string& where)
    : mass(properties.mass), inertia(properties.inertia), locked(locked_freedoms) {
  if (!(mass > 0 && std::isfinite(mass)))
    throw dem::InputError(where, fmt::format("the impactor's mass is {} kg", mass),
                          "it must be positive and finite");
  const bool sound = inertia.allFinite() && inertia.isApprox(inertia.transpose(), 1e-9);
  const double smallest =
      sound ? Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues()[0] : 0;
  if (!(smallest > 0))
    throw dem::InputError(where, fmt::format("the impactor's smallest moment of inertia is {} kg m2", smallest),
                          "the inertia must be symmetric, positive and finite");
  inertia = 0.5 * (inertia + inertia.transpose()).eval();
  inverse_inertia = inertia.inverse();
  inverse_inertia = 0.5 * (inverse_inertia + inverse_inertia.transpose()).eval();
}

Motion start_motion(const RigidBody& body, const Vec3& position, const Eigen::Quaterniond& orientation,
                    const Vec3& velocity, const Vec3& spin) {
  Motion motion;
  motion.position = position;
  motion.orientation = orientation.normalized();
  motion.velocity = velocity;
  motion.spin = spin;
  motion.angular_momentum = inertia_times(body, motion.orientation, spin);
  return motion;
}

Pose drift(const RigidBody& body, Motion& motion, double time_step) {
  Pose middle{motion.position + 0.5 * time_step * motion.velocity, motion.orientation};
  // Fixed-point iteration; contracts by about the angle per step. Round bodies are there at once.
  constexpr int most_rounds = 60;
  double change = 0, speed = 0;
  for (int round = 0; round < most_rounds; ++round) {
    middle.orientation = (turned_by(0.5 * time_step * motion.spin) * motion.orientation).normalized();
    const Vec3 spin = spin_of(body, middle.orientation, motion.angular_momentum, motion.spin);
    change = (spin - motion.spin).norm(), speed = spin.norm();
    motion.spin = spin;
    if (change <= 1e-15 * speed) break;
  }
  if (!(change <= 1e-12 * speed))
    throw dem::RunError(
        fmt::format("the impactor turns by {:.3g} rad in one step of {:.3g} s, too far to follow; a smaller "
                    "time step would help if its spin is meant",
                    speed * time_step, time_step));
  if (any_rotation_locked(body)) {
    const Vec3 held = inertia_times(body, middle.orientation, motion.spin);
    for (int k = 0; k < 3; ++k)
      if (body.keeps_spin(k)) {
        const double given = held[k] - motion.angular_momentum[k];
        motion.support_angular_impulse[k] += given;
        motion.support_work += given * motion.spin[k];
        motion.angular_momentum[k] = held[k];
      }
  }
  motion.position += time_step * motion.velocity;
  motion.orientation = (turned_by(time_step * motion.spin) * motion.orientation).normalized();
  return middle;
}

double kick(const RigidBody& body, Motion& motion, const Vec3& force, const Vec3& moment, double time_step) {
  const Vec3 velocity = motion.velocity, angular = motion.angular_momentum;
  for (int k = 0; k < 3; ++k) {
    const double impulse = time_step * force[k];
    if (body.keeps_velocity(k)) {
      motion.support_impulse[k] -= impulse;
      motion.support_work -= impulse * velocity[k];
    } else {
      motion.velocity[k] += impulse / body.mass;
    }
  }
  motion.angular_momentum += time_step * moment;
  // What a locked axis gets its support gives back in the next drift; the energy does not see it meanwhile.
  Vec3 reached = motion.angular_momentum;
  for (int k = 0; k < 3; ++k)
    if (body.keeps_spin(k)) reached[k] = angular[k];
  const Vec3 spin = motion.orientation * (body.inverse_inertia * (motion.orientation.conjugate() * reached));
  return 0.5 * (body.mass * velocity.dot(motion.velocity) + angular.dot(spin));
}

}  // namespace impact
