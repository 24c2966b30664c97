#include "libdem/state/particles.h"

#include <numbers>

namespace dem {

Particles::Particles(std::span<const Vec3> centres, std::span<const double> radii, double total_mass)
    : count(centres.size()),
      kinematics(count + ghost_elements),
      mass(count),
      inverse_mass(count),
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
    const double inertia = 0.4 * m * r * r;  // of a solid sphere
    for (int k = 0; k < 6; ++k) {
      mass[i].value[k] = k < 3 ? m : inertia;
      inverse_mass[i].value[k] = 1 / mass[i].value[k];
    }
  }
  // Ghosts lie a metre apart, far outside, so that a padding link between them has a distance and no force.
  kinematics[count] = {-1e3, -1e3, -1e3, 1};
  kinematics[count + 1] = {-1e3 + 1, -1e3, -1e3, 1};
}

void Particles::prescribe(std::size_t i, int dof, double value) {
  inverse_mass[i].value[dof] = 0;
  (&kinematics[i].vx)[dof] = value;
}

void Particles::release(std::size_t i, int dof) { inverse_mass[i].value[dof] = 1 / mass[i].value[dof]; }

void Particles::set_velocity(std::size_t i, const Vec3& velocity, const Vec3& spin) {
  Kinematics& k = kinematics[i];
  k.vx = velocity.x(), k.vy = velocity.y(), k.vz = velocity.z();
  k.wx = spin.x(), k.wy = spin.y(), k.wz = spin.z();
}

}  // namespace dem
