#include "libdem/state/particles.h"

#include <numbers>

namespace dem {

Particles::Particles(std::span<const Vec3> centres, std::span<const double> radii, double total_mass)
    : count(centres.size()),
      kinematics(count + ghost_elements),
      inertia(count),
      prescribed(count, 0),
      force(count),
      rotation(count, Vec3::Zero()),
      initial_position(centres.begin(), centres.end()),
      radius(radii.begin(), radii.end()) {
  double volume = 0;
  for (const double r : radii) volume += 4.0 / 3 * std::numbers::pi * r * r * r;
  const double density = total_mass / volume;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radii[i];
    kinematics[i] = {centres[i].x(), centres[i].y(), centres[i].z(), r};
    const double m = density * 4.0 / 3 * std::numbers::pi * r * r * r;
    const double moment = 0.4 * m * r * r;  // of a solid sphere
    inertia[i] = {m, moment, 1 / m, 1 / moment};
  }
  // Ghosts lie a metre apart, far outside, without weight: a padding link has a distance and no force.
  for (std::size_t ghost = 0; ghost < ghost_elements; ++ghost) {
    Kinematics& k = kinematics[count + ghost];
    k.x = -1e3 + static_cast<double>(ghost), k.y = k.z = -1e3, k.radius = 1, k.weight = 0;
  }
}

void Particles::prescribe(std::size_t i, int dof, double value) {
  prescribed[i] = static_cast<std::uint8_t>(prescribed[i] | 1u << dof);
  kinematics[i].rate(dof) = value;
}

void Particles::release(std::size_t i, int dof) {
  prescribed[i] = static_cast<std::uint8_t>(prescribed[i] & ~(1u << dof));
}

void Particles::set_weight(std::size_t i, double weight) {
  const double change = weight / kinematics[i].weight;
  kinematics[i].weight = weight;
  Inertia& own = inertia[i];
  own.mass *= change, own.moment *= change;
  own.inverse_mass = 1 / own.mass, own.inverse_moment = 1 / own.moment;
}

void Particles::set_velocity(std::size_t i, const Vec3& velocity, const Vec3& spin) {
  Kinematics& k = kinematics[i];
  k.vx = velocity.x(), k.vy = velocity.y(), k.vz = velocity.z();
  k.wx = spin.x(), k.wy = spin.y(), k.wz = spin.z();
}

}  // namespace dem
