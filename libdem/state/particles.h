// The discrete elements: rigid spheres with three displacements and three rotations.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/aligned.h"
#include "libdem/core/vector.h"

namespace dem {

/// What a pair needs of an element, side by side in memory because the loop over pairs reads all of it at once.
/// Positions at time t_n [m], velocities at t_(n-1/2) or t_(n+1/2) [m/s, rad/s] (Eq. 9 as leapfrog).
struct Kinematics {
  double x = 0, y = 0, z = 0, radius = 0;
  double vx = 0, vy = 0, vz = 0;  ///< velocity
  double wx = 0, wy = 0, wz = 0;  ///< angular velocity
  double weight = 1;              ///< of its stiffness and strength, see Particles::set_weight [-]
  double unused = 0;              ///< rows are whole vectors of four

  Vec3 position() const { return {x, y, z}; }
  Vec3 velocity() const { return {vx, vy, vz}; }
  Vec3 spin() const { return {wx, wy, wz}; }

  /// The six rates vx to wz by number, 0 to 5: they lie one after another, see the assertions below.
  // cppcheck-suppress objectIndex
  double& rate(int c) { return (&vx)[c]; }
  // cppcheck-suppress objectIndex
  double rate(int c) const { return (&vx)[c]; }
};
static_assert(sizeof(Kinematics) == 12 * sizeof(double));
static_assert(offsetof(Kinematics, wz) == offsetof(Kinematics, vx) + 5 * sizeof(double));

/// Six numbers of one element, force then moment or mass then inertia, in a row of eight.
struct alignas(64) SixRow {
  double value[8] = {};
};

/// What the equation of motion needs of an element.
struct alignas(32) Inertia {
  double mass = 0, moment = 0;                  ///< m [kg], I [kg m2]
  double inverse_mass = 0, inverse_moment = 0;  ///< 1/m, 1/I
};

/// Number of ghost elements at the end of Particles::kinematics that the padding of the link columns points to.
inline constexpr std::size_t ghost_elements = 2;

/// The columns of all elements. `count` elements; every column is at least that long.
struct Particles {
  std::size_t count = 0;
  Column<Kinematics> kinematics;  ///< count + ghost_elements rows
  Column<Inertia> inertia;
  Column<std::uint8_t> prescribed;  ///< bit per degree of freedom that keeps its velocity
  Column<SixRow> force;             ///< resultant at t_n: force [N], moment [N m]; see StepOptions::all_forces
  std::vector<Vec3> rotation;       ///< accumulated rotation, the integral of the spin [rad]
  std::vector<Vec3> initial_position;  ///< [m]
  std::vector<double> radius;          ///< [m]

  /// Elements at rest. Sphere mass is scaled so that all of them together weigh `total_mass` [kg].
  Particles(std::span<const Vec3> centres, std::span<const double> radii, double total_mass);
  Particles() = default;

  Vec3 displacement(std::size_t i) const { return kinematics[i].position() - initial_position[i]; }
  double element_mass(std::size_t i) const { return inertia[i].mass; }
  double element_inertia(std::size_t i) const { return inertia[i].moment; }
  bool is_prescribed(std::size_t i, int dof) const { return (prescribed[i] >> dof & 1) != 0; }

  /// Makes degree of freedom `dof` (0..2 displacements, 3..5 rotations) of element i keep the velocity `value`.
  void prescribe(std::size_t i, int dof, double value);
  /// Hands degree of freedom `dof` back to the equation of motion.
  void release(std::size_t i, int dof);
  /// Gives element i the part `weight` (above 0, at most 1) of its mass and inertia, and its pairs the smaller
  /// of their two elements' weights of their stiffness and strength: the energy weight of a bridging domain.
  void set_weight(std::size_t i, double weight);
  void set_velocity(std::size_t i, const Vec3& velocity, const Vec3& spin = Vec3::Zero());
};

}  // namespace dem
