#include "specimens/virtual_tests/static_start.h"

#include <Eigen/Dense>
#include <algorithm>

#include "libdem/statics/static_solve.h"

namespace virtual_tests {
namespace {

using Modes = Eigen::Matrix<double, 6, 6>;
using Motion = Eigen::Matrix<double, 6, 1>;

/// What the six motions of the body as a whole are at an element: three shifts, three turns about `centre` that
/// move a point at distance `arm` as far as a shift does.
Modes motions_at(const dem::Vec3& x, const dem::Vec3& centre, double arm) {
  Modes modes = Modes::Zero();
  const dem::Vec3 r = (x - centre) / arm;
  for (int m = 0; m < 3; ++m) {
    modes(m, m) = 1;
    const dem::Vec3 turn = dem::Vec3::Unit(m);
    modes.block<3, 1>(0, 3 + m) = turn.cross(r);
    modes(3 + m, 3 + m) = 1 / arm;
  }
  return modes;
}

/// Takes out of the velocities the motions of the body as a whole that nothing holds: the solver leaves any
/// amount of them in, since they cost no force.
void stop_free_motions(dem::Particles& particles) {
  dem::Vec3 centre = dem::Vec3::Zero();
  for (const dem::Vec3& x : particles.initial_position) centre += x;
  centre /= static_cast<double>(particles.count);
  double arm = 0;
  for (const dem::Vec3& x : particles.initial_position) arm = std::max(arm, (x - centre).norm());

  Modes held = Modes::Zero();
  for (std::size_t i = 0; i < particles.count; ++i) {
    if (particles.prescribed[i] == 0) continue;
    const Modes at = motions_at(particles.initial_position[i], centre, arm);
    for (int c = 0; c < 6; ++c)
      if (particles.is_prescribed(i, c)) held += at.row(c).transpose() * at.row(c);
  }
  const Eigen::SelfAdjointEigenSolver<Modes> solver(held);
  const double largest = solver.eigenvalues().maxCoeff();
  Eigen::Index free = 0;  // eigenvalues rise
  while (free < 6 && solver.eigenvalues()[free] < 1e-9 * largest) ++free;
  if (free == 0) return;
  const auto motions = solver.eigenvectors().leftCols(free);

  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(free, free);
  Eigen::VectorXd momentum = Eigen::VectorXd::Zero(free);
  const auto inertia_of = [&](std::size_t i) {
    Motion own;
    own.head<3>().setConstant(particles.element_mass(i));
    own.tail<3>().setConstant(particles.element_inertia(i));
    return own;
  };
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Eigen::MatrixXd at = motions_at(particles.initial_position[i], centre, arm) * motions;
    const Motion inertia = inertia_of(i), velocity = Eigen::Map<const Motion>(&particles.kinematics[i].vx);
    mass += at.transpose() * inertia.asDiagonal() * at;
    momentum += at.transpose() * inertia.cwiseProduct(velocity);
  }
  const Eigen::VectorXd amount = motions * mass.ldlt().solve(momentum);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Motion whole = motions_at(particles.initial_position[i], centre, arm) * amount;
    for (int c = 0; c < 6; ++c)
      if (!particles.is_prescribed(i, c)) particles.kinematics[i].rate(c) -= whole[c];
  }
}

}  // namespace

void start_as_elastic(dem::Particles& particles, const dem::LinkNetwork& network) {
  std::vector<std::uint8_t> held(6 * particles.count, 0);
  std::vector<double> motion(6 * particles.count, 0.0);
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int c = 0; c < 6; ++c)
      if (particles.is_prescribed(i, c)) {
        held[6 * i + static_cast<std::size_t>(c)] = 1;
        motion[6 * i + static_cast<std::size_t>(c)] = particles.kinematics[i].rate(c);
      }
  const dem::StaticSolution solution = dem::solve_static(network, std::move(held), std::move(motion), 1e-7);
  for (std::size_t i = 0; i < particles.count; ++i)
    for (std::size_t c = 0; c < 6; ++c) {
      particles.kinematics[i].rate(c) = solution.displacement[6 * i + c];
      particles.force[i].value[c] = -solution.force[6 * i + c];  // what the links exert on the element
    }
  stop_free_motions(particles);
}

}  // namespace virtual_tests
