#include "impact/fe/hexahedron.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace fe {
namespace {

/// Local coordinates of the nodes.
constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// The rows that displacement gradient (dx, dy, dz) of one node adds to the strain.
Eigen::Matrix<double, 6, 3> node_strain(double dx, double dy, double dz) {
  Eigen::Matrix<double, 6, 3> b;
  b << dx, 0, 0,  //
      0, dy, 0,   //
      0, 0, dz,   //
      dy, dx, 0,  //
      0, dz, dy,  //
      dz, 0, dx;
  return b;
}

}  // namespace

const std::array<Vec3, 8>& gauss_points() {
  static const std::array<Vec3, 8> points = [] {
    const double q = 1 / std::sqrt(3.0);
    std::array<Vec3, 8> made;
    for (std::size_t g = 0; g < 8; ++g) made[g] = Vec3(g & 1 ? q : -q, g & 2 ? q : -q, g & 4 ? q : -q);
    return made;
  }();
  return points;
}

ShapeValues shape_values(const Vec3& local) {
  ShapeValues n;
  for (int a = 0; a < 8; ++a)
    n[a] =
        0.125 * (1 + corner[a][0] * local[0]) * (1 + corner[a][1] * local[1]) * (1 + corner[a][2] * local[2]);
  return n;
}

ShapeGradients local_gradients(const Vec3& local) {
  ShapeGradients d;
  for (int a = 0; a < 8; ++a) {
    const double x = 1 + corner[a][0] * local[0], y = 1 + corner[a][1] * local[1],
                 z = 1 + corner[a][2] * local[2];
    d.row(a) << 0.125 * corner[a][0] * y * z, 0.125 * corner[a][1] * x * z, 0.125 * corner[a][2] * x * y;
  }
  return d;
}

Mat3 jacobian(const Corners& corners, const Vec3& local) {
  return local_gradients(local).transpose() * corners;
}

ShapeGradients gradients(const Corners& corners, const Vec3& local) {
  const ShapeGradients d = local_gradients(local);
  const Mat3 j = d.transpose() * corners;
  return d * j.inverse().transpose();
}

Vec3 position(const Corners& corners, const Vec3& local) { return corners.transpose() * shape_values(local); }

std::optional<Vec3> local_coordinates(const Corners& corners, const Vec3& wanted) {
  Vec3 local = Vec3::Zero();
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Vec3 miss = wanted - position(corners, local);
    const Mat3 j = jacobian(corners, local);
    const Vec3 change = j.transpose().partialPivLu().solve(miss);
    if (!change.allFinite()) return std::nullopt;
    local += change;
    if (change.cwiseAbs().maxCoeff() < 1e-13) return local;
    if (local.cwiseAbs().maxCoeff() > 1e3) return std::nullopt;
    // Rounding of large coordinates may keep the last digit moving.
    if (iteration > 30 && change.cwiseAbs().maxCoeff() < 1e-12) return local;
  }
  return std::nullopt;
}

Eigen::Matrix<double, 6, 24> strain_matrix(const ShapeGradients& gradients) {
  Eigen::Matrix<double, 6, 24> b;
  for (int a = 0; a < 8; ++a)
    b.middleCols<3>(3 * a) = node_strain(gradients(a, 0), gradients(a, 1), gradients(a, 2));
  return b;
}

ElementMatrix element_stiffness(const Corners& corners, const Material& material, Formulation formulation,
                                const GaussWeights& weights) {
  using Modes = Eigen::Matrix<double, 6, 9>;
  const Eigen::Matrix<double, 6, 6> c = material.elasticity();
  std::array<Modes, 8> modes;
  std::array<double, 8> share{};  // weight times volume of a Gauss point [m3]
  Modes mean = Modes::Zero();
  double total = 0;
  for (std::size_t g = 0; g < 8; ++g) {
    const Vec3& point = gauss_points()[g];
    const Mat3 j = jacobian(corners, point);
    const Mat3 inverse = j.inverse();
    share[g] = weights[g] * j.determinant();
    for (int i = 0; i < 3; ++i) {  // mode 1 - local_i^2, in the three directions
      const Vec3 d = inverse.col(i) * (-2 * point[i]);
      modes[g].middleCols<3>(3 * i) = node_strain(d[0], d[1], d[2]);
    }
    mean += share[g] * modes[g];
    total += share[g];
  }
  // The modes' mean strain is taken out: a constant strain then does no work on them, whatever shape and
  // weights.
  mean /= total;

  ElementMatrix k = ElementMatrix::Zero();
  Eigen::Matrix<double, 9, 24> coupling = Eigen::Matrix<double, 9, 24>::Zero();
  Eigen::Matrix<double, 9, 9> inner = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t g = 0; g < 8; ++g) {
    const auto b = strain_matrix(gradients(corners, gauss_points()[g]));
    const Eigen::Matrix<double, 6, 24> stress = share[g] * c * b;
    k.noalias() += b.transpose() * stress;
    if (formulation == Formulation::trilinear) continue;
    const Modes mode = modes[g] - mean;
    coupling.noalias() += mode.transpose() * stress;
    inner.noalias() += share[g] * mode.transpose() * c * mode;
  }
  if (formulation == Formulation::incompatible_modes) k -= coupling.transpose() * inner.llt().solve(coupling);
  return 0.5 * (k + k.transpose());  // symmetric to the last bit
}

ShapeValues lumped_mass(const Corners& corners, double density, const GaussWeights& weights) {
  ShapeValues mass = ShapeValues::Zero();
  for (std::size_t g = 0; g < 8; ++g) {
    const Vec3& point = gauss_points()[g];
    mass += density * weights[g] * jacobian(corners, point).determinant() * shape_values(point);
  }
  return mass;
}

double volume(const Corners& corners) {
  double sum = 0;
  for (const Vec3& point : gauss_points()) sum += jacobian(corners, point).determinant();
  return sum;
}

}  // namespace fe
