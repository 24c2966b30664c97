// The hexahedron: shape functions, rigid motions, the patch test on distorted elements, weighted energy.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "impact/fe/hexahedron.h"
#include "impact/fe/motion.h"
#include "tests/verification/fe_scene.h"

using fe::Formulation;
using fe::Vec3;

namespace {

fe::Corners skewed_corners(std::uint64_t seed) {
  fe::Corners corners = fe_scene::box(Vec3(0.05, 0.04, 0.03), {1, 1, 1}, Vec3(1, -2, 3)).corners(0);
  dem::Random random(seed);
  for (int a = 0; a < 8; ++a)
    for (int k = 0; k < 3; ++k) corners(a, k) += random.uniform(-0.005, 0.005);
  return corners;
}

fe::GaussWeights uneven_weights() { return {0.02, 0.9, 0.3, 0.5, 0.7, 0.1, 0.98, 0.4}; }

}  // namespace

class Hexahedron : public testing::TestWithParam<Formulation> {};
INSTANTIATE_TEST_SUITE_P(Both, Hexahedron,
                         testing::Values(Formulation::trilinear, Formulation::incompatible_modes),
                         [](const auto& of) {
                           return of.param == Formulation::trilinear ? "trilinear" : "modes";
                         });

TEST(ShapeFunctions, SumToOneAndReproduceLinearFields) {
  const fe::Corners corners = skewed_corners(5);
  fe::Mat3 slope;
  slope << 1, -2, 3, 0.5, 4, -1, 2, 0, -3;
  const Eigen::Matrix<double, 8, 3> field = corners * slope.transpose();
  for (const Vec3& local : {Vec3(0.1, -0.7, 0.4), Vec3(-1, 1, 0.2), Vec3(0, 0, 0)}) {
    EXPECT_NEAR(fe::shape_values(local).sum(), 1, 1e-15);
    const Vec3 there = fe::position(corners, local);
    EXPECT_LT((field.transpose() * fe::shape_values(local) - slope * there).norm(), 1e-13);
    const fe::Mat3 gradient = field.transpose() * fe::gradients(corners, local);
    EXPECT_LT((gradient - slope).norm(), 1e-12);
  }
}

TEST_P(Hexahedron, CostsNothingToMoveRigidlyAndOnlyThat) {
  const fe::Corners corners = skewed_corners(2);
  const fe::ElementMatrix k =
      fe::element_stiffness(corners, fe_scene::concrete(), GetParam(), uneven_weights());
  EXPECT_EQ((k - k.transpose()).norm(), 0);
  const double scale = k.norm();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Matrix<double, 24, 1> shift, turn;
    for (int a = 0; a < 8; ++a) {
      shift.segment<3>(3 * a) = Vec3::Unit(axis);
      turn.segment<3>(3 * a) =
          Vec3::Unit(axis).cross(Vec3(corners.row(a).transpose() - corners.row(0).transpose()));
    }
    EXPECT_LT((k * shift).norm(), 1e-14 * scale);
    EXPECT_LT((k * turn).norm(), 1e-14 * scale * turn.norm());
  }
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<fe::ElementMatrix>(k).eigenvalues();
  EXPECT_GT(values[6], 1e-4 * values[23]) << "no mode but the six rigid ones is free";
  EXPECT_GT(values[0], -1e-12 * values[23]);
}

TEST_P(Hexahedron, StoresTheWeightedEnergyOfAConstantStrain) {
  const fe::Material material = fe_scene::concrete();
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const fe::Corners corners = skewed_corners(seed);
    const fe::GaussWeights weights = uneven_weights();
    fe::Mat3 slope;
    slope << 1, 2, -1, 0.4, -3, 2, 1, 5, 0.5;
    Eigen::Matrix<double, 24, 1> u;
    for (int a = 0; a < 8; ++a) u.segment<3>(3 * a) = 1e-4 * slope * corners.row(a).transpose();
    Eigen::Matrix<double, 6, 1> strain;
    strain << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1),
        slope(2, 0) + slope(0, 2);
    strain *= 1e-4;
    double weighted_volume = 0;
    for (std::size_t g = 0; g < 8; ++g)
      weighted_volume += weights[g] * fe::jacobian(corners, fe::gauss_points()[g]).determinant();
    const double expected = 0.5 * weighted_volume * strain.dot(material.elasticity() * strain);
    const double stored = 0.5 * u.dot(fe::element_stiffness(corners, material, GetParam(), weights) * u);
    EXPECT_NEAR(stored, expected, 1e-11 * expected);
    EXPECT_NEAR(fe::lumped_mass(corners, 2500, weights).sum(), 2500 * weighted_volume,
                1e-11 * 2500 * weighted_volume);
    EXPECT_GT(fe::lumped_mass(corners, 2500, weights).minCoeff(), 0);
  }
}

TEST_P(Hexahedron, PassesThePatchTest) {
  const fe::Mesh mesh = fe_scene::distorted(fe_scene::box(Vec3(0.3, 0.3, 0.3), {3, 3, 3}), 0.02);
  const fe::Body body(mesh, fe_scene::concrete(), fe_scene::with(GetParam()));
  fe::Mat3 slope;
  slope << 3, 1, -2, 0.5, -1, 2, 1, -4, 2;
  slope *= 1e-5;
  std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, false, false});
  std::vector<Vec3> exact, load(mesh.nodes.size(), Vec3::Zero());
  int inner = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    exact.push_back(slope * mesh.nodes[i]);
    const bool surface = (mesh.nodes[i].array() < 1e-9).any() || (mesh.nodes[i].array() > 0.3 - 1e-9).any();
    held[i].fill(surface);
    inner += surface ? 0 : 1;
  }
  ASSERT_EQ(inner, 8);
  const fe::StaticSolution solution = fe::solve_static(body, load, held, exact);
  double work = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    EXPECT_LT((solution.displacement[i] - exact[i]).norm(), 1e-12 * 0.3 * slope.norm()) << "node " << i;
    work += 0.5 * solution.reaction[i].dot(exact[i]);
  }
  Eigen::Matrix<double, 6, 1> strain;
  strain << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1),
      slope(2, 0) + slope(0, 2);
  const double energy = 0.5 * 0.027 * strain.dot(fe_scene::concrete().elasticity() * strain);
  EXPECT_NEAR(work, energy, 1e-11 * energy);
}

TEST_P(Hexahedron, LoopOverElementsEqualsTheAssembledMatrix) {
  const fe::Mesh mesh = fe_scene::distorted(fe_scene::box(Vec3(0.5, 0.3, 0.2), {5, 3, 2}), 0.02, 7);
  const fe::Body body(mesh, fe_scene::concrete(), fe_scene::with(GetParam()));
  fe::State state(body);
  dem::Random random(4);
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * body.nodes()));
  for (std::size_t i = 0; i < body.nodes(); ++i) {
    state.displacement[i] = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    u.segment<3>(static_cast<Eigen::Index>(3 * i)) = state.displacement[i];
  }
  fe::ElementRows room;
  fe::internal_force(body, state, room);
  const Eigen::VectorXd expected = -(fe::assemble(body) * u);
  for (std::size_t i = 0; i < body.nodes(); ++i)
    EXPECT_LT((state.force[i] - expected.segment<3>(static_cast<Eigen::Index>(3 * i))).norm(),
              1e-13 * expected.norm());
}

TEST(Body, SharesOneStiffnessAmongEqualElements) {
  const fe::Body body(fe_scene::box(Vec3(2.5, 2.0, 0.28), {25, 20, 4}, Vec3(0.1, 0.2, 0.3)),
                      fe_scene::concrete());
  EXPECT_EQ(body.stiffness.size(), 1u);
  EXPECT_NEAR(body.total_mass(), 2500 * 2.5 * 2.0 * 0.28, 1e-9);
}
