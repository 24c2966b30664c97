#include "impact/fe/critical_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "impact/fe/motion.h"
#include "libdem/core/error.h"
#include "libdem/core/random.h"

namespace fe {

double critical_time_step(const Body& body) {
  double largest = 0;
  for (std::size_t c = 0; c < body.stiffness.size(); ++c) {
    Eigen::Matrix<double, 24, 1> inverse_root;
    for (int i = 0; i < 24; ++i) inverse_root[i] = 1 / std::sqrt(body.corner_mass[c][i / 3]);
    const ElementMatrix scaled = inverse_root.asDiagonal() * body.stiffness[c] * inverse_root.asDiagonal();
    largest = std::max(
        largest,
        Eigen::SelfAdjointEigenSolver<ElementMatrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
  }
  return 2 / std::sqrt(largest);
}

double highest_frequency(const Body& body) {
  State state(body);
  ElementRows room;
  const auto size = static_cast<Eigen::Index>(3 * body.nodes());
  Eigen::VectorXd inverse_root = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < body.nodes(); ++i)
    if (body.node_mass[i] > 0)
      inverse_root.segment<3>(static_cast<Eigen::Index>(3 * i)).setConstant(1 / std::sqrt(body.node_mass[i]));
  Eigen::Map<Eigen::VectorXd> displacement(state.displacement.front().data(), size),
      force(state.force.front().data(), size);

  dem::Random random(20071);
  Eigen::VectorXd current(size), previous = Eigen::VectorXd::Zero(size), product(size);
  for (double& x : current) x = random.uniform(-1, 1);
  current.normalize();
  std::vector<double> diagonal, beside;
  double largest = 0;
  for (int k = 0; k < 300; ++k) {
    displacement = inverse_root.cwiseProduct(current);
    internal_force(body, state, room);
    product = -inverse_root.cwiseProduct(force);
    diagonal.push_back(current.dot(product));
    product -= diagonal.back() * current + (beside.empty() ? 0.0 : beside.back()) * previous;
    const double norm = product.norm();
    if (k % 10 == 9 || norm == 0) {
      const auto n = static_cast<Eigen::Index>(diagonal.size());
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), n),
                                    Eigen::Map<Eigen::VectorXd>(beside.data(), n - 1), Eigen::EigenvaluesOnly);
      const double found = solver.eigenvalues().maxCoeff();
      const bool settled = found - largest <= 1e-5 * found || norm == 0;
      largest = found;
      if (settled) break;
    }
    beside.push_back(norm);
    previous = current;
    current = product / norm;
  }
  if (!(largest > 0) || !std::isfinite(largest))
    throw dem::RunError("the finite elements have no stiffness, hence no critical time step");
  return std::sqrt(largest);
}

}  // namespace fe
