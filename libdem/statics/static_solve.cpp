#include "libdem/statics/static_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"

namespace dem {
namespace {

using Block = Eigen::Matrix<double, 6, 6>;
using Six = Eigen::Matrix<double, 6, 1>;

Mat3 cross_matrix(const Vec3& n) {
  Mat3 m;
  m << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return m;
}

/// Inverses of the diagonal blocks, with held degrees of freedom cut out.
std::vector<Block> preconditioner(const LinkNetwork& network, const std::vector<std::uint8_t>& held) {
  std::vector<Block> blocks(network.elements, Block::Zero());
  for (const LinkSpring& s : network.springs) {
    const Mat3 tangent = s.shear_stiffness * Mat3::Identity() +
                         (s.normal_stiffness - s.shear_stiffness) * s.normal * s.normal.transpose();
    const Mat3 turn = cross_matrix(s.normal);
    for (const bool first : {true, false}) {
      Eigen::Matrix<double, 3, 6> gradient;
      gradient.leftCols<3>() = (first ? -1.0 : 1.0) * Mat3::Identity();
      gradient.rightCols<3>() = (first ? s.arm_a : s.arm_b) * turn;
      Block& block = blocks[static_cast<std::size_t>(first ? s.a : s.b)];
      block += gradient.transpose() * tangent * gradient;
      block.bottomRightCorner<3, 3>() +=
          s.rolling_stiffness * Mat3::Identity() +
          (s.twisting_stiffness - s.rolling_stiffness) * s.normal * s.normal.transpose();
    }
  }
  for (std::size_t i = 0; i < network.elements; ++i) {
    Block& block = blocks[i];
    const double scale = block.trace();
    for (int c = 0; c < 6; ++c) {
      if (held[6 * i + static_cast<std::size_t>(c)]) {
        block.row(c).setZero();
        block.col(c).setZero();
        block(c, c) = 1;
      } else if (block(c, c) <= 1e-14 * scale) {
        block(c, c) += 1;
      }
      block(c, c) *= 1 + 1e-10;
    }
    block = Block(block.inverse());
  }
  return blocks;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return Eigen::Map<const Eigen::VectorXd>(a.data(), static_cast<Eigen::Index>(a.size()))
      .dot(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size())));
}

}  // namespace

StaticSolution solve_static(const LinkNetwork& network, std::vector<std::uint8_t> held,
                            std::vector<double> displacement, double tolerance) {
  const std::size_t size = 6 * network.elements;
  const std::vector<int> coordination = network.coordination();
  for (std::size_t i = 0; i < network.elements; ++i)
    if (coordination[i] < 3)  // a mechanism: nothing holds it in place
      for (std::size_t c = 0; c < 6; ++c) held[6 * i + c] = 1;
  const std::vector<Block> inverse = preconditioner(network, held);

  std::vector<double> residual(size), corrected(size), direction(size), product(size);
  network.multiply(displacement, residual);
  double reaction = 0;
  for (std::size_t k = 0; k < size; ++k) {
    if (held[k]) reaction += residual[k] * residual[k];
    residual[k] = held[k] ? 0 : -residual[k];
  }
  const auto precondition = [&] {
    for (std::size_t i = 0; i < network.elements; ++i)
      Eigen::Map<Six>(corrected.data() + 6 * i) = inverse[i] * Eigen::Map<const Six>(residual.data() + 6 * i);
  };
  precondition();
  direction = corrected;
  double rz = dot(residual, corrected);
  const double goal = tolerance * tolerance * reaction;
  StaticSolution solution;
  const int most = 20000;
  while (dot(residual, residual) > goal) {
    if (interrupt_requested()) throw Interrupted("stopped by a signal");
    if (++solution.iterations > most || !std::isfinite(rz))
      throw RunError(
          "the static solve of the link network does not converge; the specimen may be loose or cut in two");
    network.multiply(direction, product);
    for (std::size_t k = 0; k < size; ++k)
      if (held[k]) product[k] = 0;
    const double along = rz / dot(direction, product);
    for (std::size_t k = 0; k < size; ++k)
      displacement[k] += along * direction[k], residual[k] -= along * product[k];
    precondition();
    const double next = dot(residual, corrected), ratio = next / rz;
    rz = next;
    for (std::size_t k = 0; k < size; ++k) direction[k] = corrected[k] + ratio * direction[k];
  }
  solution.force.resize(size);
  network.multiply(displacement, solution.force);
  solution.displacement = std::move(displacement);
  return solution;
}

}  // namespace dem
