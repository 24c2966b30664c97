#include "libdem/motion/critical_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "libdem/core/error.h"
#include "libdem/core/random.h"

namespace dem {

double critical_time_step(const LinkNetwork& network, const Particles& particles) {
  const auto size = static_cast<Eigen::Index>(6 * network.elements);
  Eigen::VectorXd inverse_root(
      size);  // M^(-1/2), of all degrees of freedom: a support that is released must not diverge
  for (std::size_t i = 0; i < network.elements; ++i)
    for (std::size_t c = 0; c < 6; ++c)
      inverse_root[static_cast<Eigen::Index>(6 * i + c)] =
          1 / std::sqrt(c < 3 ? particles.element_mass(i) : particles.element_inertia(i));

  Random random(20071);
  Eigen::VectorXd current(size), previous = Eigen::VectorXd::Zero(size), scaled(size), product(size);
  for (double& x : current) x = random.uniform(-1, 1);
  current.normalize();
  std::vector<double> diagonal, beside;
  double largest = 0;
  for (int k = 0; k < 200; ++k) {
    scaled = inverse_root.cwiseProduct(current);
    network.multiply({scaled.data(), static_cast<std::size_t>(size)},
                     {product.data(), static_cast<std::size_t>(size)});
    product = inverse_root.cwiseProduct(product);
    diagonal.push_back(current.dot(product));
    product -= diagonal.back() * current + (beside.empty() ? 0.0 : beside.back()) * previous;
    const double norm = product.norm();
    if (k % 10 == 9 || norm == 0) {
      const auto n = static_cast<Eigen::Index>(diagonal.size());
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), n),
                                    Eigen::Map<Eigen::VectorXd>(beside.data(), n - 1), Eigen::EigenvaluesOnly);
      const double found = solver.eigenvalues().maxCoeff();
      if (found - largest <= 1e-4 * found || norm == 0) {
        largest = found;
        break;
      }
      largest = found;
    }
    beside.push_back(norm);
    previous = current;
    current = product / norm;
  }
  if (!(largest > 0) || !std::isfinite(largest))
    throw RunError("the link network has no stiffness, hence no critical time step");
  return 2 / std::sqrt(largest);
}

}  // namespace dem
