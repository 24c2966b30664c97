// The tie itself: against the dense solve, momentum, weights, any orientation, all round the zone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>

#include "impact/coupling/multipliers.h"
#include "impact/coupling/sub_stepping.h"
#include "impact/fe/box_mesh.h"
#include "impact/fe/critical_step.h"
#include "libdem/core/error.h"
#include "libdem/core/random.h"

namespace {

using coupling::Ties;
using dem::Mat3;
using dem::Vec3;

/// Finite elements round a cube of random discrete elements, the whole turned and shifted.
struct Island {
  Mat3 turn;
  Vec3 shift;
  coupling::Zone zone;
  fe::Mesh mesh;
  std::vector<Vec3> centres;
  std::optional<fe::Body> body;
  std::optional<fe::State> nodes;
  std::vector<double> weights;
  std::vector<double> velocity;  // six a discrete element
  dem::Random random{11};

  explicit Island(const Mat3& rotation = Mat3::Identity(), const Vec3& moved = Vec3::Zero(),
                  int elements = 1500)
      : turn(rotation), shift(moved) {
    fe::BoxMeshOptions options;
    options.origin = Vec3::Constant(-0.8);
    options.size = Vec3::Constant(1.6);
    options.elements = {8, 8, 8};
    options.zone = fe::DiscreteZone{Vec3::Constant(-0.6), Vec3::Constant(0.6), 2};  // all round
    mesh = fe::box_mesh(options);
    for (Vec3& node : mesh.nodes) node = turn * node + shift;
    zone.centre = shift, zone.axes = turn, zone.half_size = Vec3::Constant(0.6), zone.thickness = 0.4;
    zone.coupled.fill(true);
    for (int i = 0; i < elements; ++i)
      centres.push_back(
          turn * Vec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)) + shift);
    fe::BodyOptions weighted;
    weighted.weights = coupling::finite_weights(zone, mesh);
    body.emplace(mesh, fe::Material{30e9, 0.2, 2500}, weighted);
    nodes.emplace(*body);
    weights = coupling::discrete_weights(zone, centres);
    for (int i = 0; i < 6 * elements; ++i) velocity.push_back(random.uniform(-1, 1));
    for (Vec3& v : nodes->velocity)
      v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }

  coupling::DiscreteMasses masses(const coupling::KinematicMap& map) const {
    coupling::DiscreteMasses result;
    for (const std::int32_t i : map.elements) {
      const double m = weights[static_cast<std::size_t>(i)] * (1 + 0.3 * std::sin(i)), inertia = 0.4 * m * 1e-4;
      result.row.push_back({m, m, m, inertia, inertia, inertia});
    }
    return result;
  }
};

Mat3 some_turn() { return Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix(); }

/// The velocities after C M^-1 C^T lambda = C v by a dense solve of all multipliers; locked or prescribed
/// motions have no inverse mass.
void dense_solve(const Island& island, const coupling::KinematicMap& map,
                 const coupling::DiscreteMasses& masses, std::vector<double>& velocity,
                 std::vector<Vec3>& node_velocity) {
  const auto n = static_cast<Eigen::Index>(map.elements.size()),
             m = static_cast<Eigen::Index>(map.nodes.size());
  const bool rotations = map.ties == Ties::displacements_and_rotations;
  const Eigen::Index rows = (rotations ? 6 : 3) * n;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(rows, 3 * m);
  const Eigen::MatrixXd shape(map.k);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j)
      for (int c = 0; c < 3; ++c) k(3 * i + c, 3 * j + c) = shape(i, j);
  if (rotations) k.bottomRows(3 * n) = Eigen::MatrixXd(map.h);
  Eigen::VectorXd inverse_element(rows), inverse_node(3 * m), v(rows), u(3 * m);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto i = static_cast<std::size_t>(row % (3 * n) / 3);
    const std::size_t c = static_cast<std::size_t>(row % 3) + (row >= 3 * n ? 3 : 0);
    inverse_element[row] = 1 / masses.row[i][c];
    v[row] = velocity[6 * static_cast<std::size_t>(map.elements[i]) + c];
  }
  for (Eigen::Index j = 0; j < 3 * m; ++j) {
    const auto node = static_cast<std::size_t>(map.nodes[static_cast<std::size_t>(j / 3)]);
    inverse_node[j] = island.nodes->inverse_mass[node][j % 3];
    u[j] = node_velocity[node][j % 3];
  }
  Eigen::MatrixXd a = k * inverse_node.asDiagonal() * k.transpose();
  a.diagonal() += inverse_element;
  const Eigen::VectorXd lambda = a.llt().solve(v - k * u);
  v -= inverse_element.cwiseProduct(lambda);
  u += inverse_node.cwiseProduct(k.transpose() * lambda);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto i = static_cast<std::size_t>(row % (3 * n) / 3);
    velocity[6 * static_cast<std::size_t>(map.elements[i]) + static_cast<std::size_t>(row % 3) +
             (row >= 3 * n ? 3 : 0)] = v[row];
  }
  for (Eigen::Index j = 0; j < 3 * m; ++j)
    node_velocity[static_cast<std::size_t>(map.nodes[static_cast<std::size_t>(j / 3)])][j % 3] = u[j];
}

template <class Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const dem::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

}  // namespace

class Tie : public testing::TestWithParam<Ties> {};
INSTANTIATE_TEST_SUITE_P(Both, Tie, testing::Values(Ties::displacements, Ties::displacements_and_rotations),
                         [](const auto& of) {
                           return of.param == Ties::displacements ? "displacements" : "rotations";
                         });

TEST_P(Tie, NodesSolveEqualsTheDenseSolveOfAllMultipliers) {
  for (const bool supported : {false, true}) {
    Island island(some_turn(), Vec3(1, -2, 3), 500);
    if (supported) {  // some nodes of the overlap are locked, not along every axis alike
      std::vector<std::int32_t> some;
      for (std::size_t i = 0; i < island.mesh.nodes.size(); i += 5)
        some.push_back(static_cast<std::int32_t>(i));
      island.nodes->lock(some, 1);
      island.nodes->lock({some.data(), some.size() / 2}, 2);
    }
    const auto map =
        coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres, GetParam());
    ASSERT_GT(map.elements.size(), 200u);
    const auto masses = island.masses(map);
    std::vector<double> expected = island.velocity;
    std::vector<Vec3> expected_nodes = island.nodes->velocity;
    dense_solve(island, map, masses, expected, expected_nodes);
    coupling::Multipliers multipliers(map, masses, *island.nodes);
    multipliers.apply({island.velocity.data(), 6}, *island.nodes, 1e-6);
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(island.velocity[i], expected[i], 1e-12);
    for (std::size_t j = 0; j < expected_nodes.size(); ++j)
      ASSERT_LT((island.nodes->velocity[j] - expected_nodes[j]).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_P(Tie, HoldsTheConstraintKeepsMomentumAndNeverGainsEnergy) {
  Island island(some_turn(), Vec3(1, -2, 3));
  const auto map =
      coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres, GetParam());
  const auto masses = island.masses(map);
  const auto sums = [&] {
    Vec3 momentum = fe::momentum(*island.nodes);
    double kinetic = fe::kinetic_energy(*island.nodes);
    for (std::size_t i = 0; i < map.elements.size(); ++i) {
      const double* v = &island.velocity[6 * static_cast<std::size_t>(map.elements[i])];
      momentum += masses.row[i][0] * Vec3(v[0], v[1], v[2]);
      for (std::size_t c = 0; c < 6; ++c) kinetic += 0.5 * masses.row[i][c] * v[c] * v[c];
    }
    return std::pair(momentum, kinetic);
  };
  const auto before = sums();
  coupling::Multipliers multipliers(map, masses, *island.nodes);
  const coupling::TieSums done = multipliers.apply({island.velocity.data(), 6}, *island.nodes, 1e-6);
  const auto after = sums();
  EXPECT_LT((after.first - before.first).norm(), 1e-11 * std::sqrt(before.second * island.body->total_mass()));
  EXPECT_LT(done.kinetic_change, 0);
  EXPECT_NEAR(after.second - before.second, done.kinetic_change, 1e-10 * before.second);
  double fastest = 0;
  for (std::size_t i = 0; i < map.elements.size(); ++i) {
    const double* v = &island.velocity[6 * static_cast<std::size_t>(map.elements[i])];
    Vec3 u = Vec3::Zero();
    for (coupling::RowMatrix::InnerIterator it(map.k, static_cast<Eigen::Index>(i)); it; ++it)
      u += it.value() *
           island.nodes->velocity[static_cast<std::size_t>(map.nodes[static_cast<std::size_t>(it.col())])];
    EXPECT_LT((u - Vec3(v[0], v[1], v[2])).norm(), 1e-12);
    fastest = std::max(fastest, Vec3(v[0], v[1], v[2]).squaredNorm());
  }
  EXPECT_DOUBLE_EQ(done.max_speed_squared, fastest);
  // What satisfies the constraint stays as it is.
  const std::vector<double> settled = island.velocity;
  EXPECT_NEAR(multipliers.apply({island.velocity.data(), 6}, *island.nodes, 1e-6).kinetic_change, 0,
              1e-20 * before.second + 1e-12);
  for (std::size_t i = 0; i < settled.size(); ++i) ASSERT_NEAR(island.velocity[i], settled[i], 1e-12);
}

TEST_P(Tie, LeavesARigidMotionAlone) {
  Island island(some_turn(), Vec3(1, -2, 3));
  const Vec3 shift(0.3, -0.2, 0.5), spin(0.1, 0.4, -0.3);
  for (std::size_t i = 0; i < island.centres.size(); ++i) {
    const Vec3 v = shift + spin.cross(island.centres[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      island.velocity[6 * i + c] = v[static_cast<Eigen::Index>(c)];
      island.velocity[6 * i + 3 + c] = spin[static_cast<Eigen::Index>(c)];
    }
  }
  for (std::size_t j = 0; j < island.mesh.nodes.size(); ++j)
    island.nodes->velocity[j] = shift + spin.cross(island.mesh.nodes[j]);
  const std::vector<double> before = island.velocity;
  const auto map =
      coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres, GetParam());
  coupling::Multipliers multipliers(map, island.masses(map), *island.nodes);
  multipliers.apply({island.velocity.data(), 6}, *island.nodes, 1e-6);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(island.velocity[i], before[i], 1e-12);
}

TEST(TieVariants, LumpedIsStableAndKeepsMomentum) {
  Island island;
  const auto map = coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres);
  const auto masses = island.masses(map);
  coupling::TieOptions options;
  options.solve = coupling::MultiplierSolve::lumped;
  coupling::Multipliers lumped(map, masses, *island.nodes, options);
  const auto momentum = [&] {
    Vec3 sum = fe::momentum(*island.nodes);
    for (std::size_t i = 0; i < map.elements.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sum[static_cast<Eigen::Index>(c)] +=
            masses.row[i][c] * island.velocity[6 * static_cast<std::size_t>(map.elements[i]) + c];
    return sum;
  };
  const Vec3 before = momentum();
  double last = -1e300;
  for (int k = 0; k < 30; ++k) {  // corrections only ever take energy, and less each time
    const double change = lumped.apply({island.velocity.data(), 6}, *island.nodes, 1e-6).kinetic_change;
    EXPECT_LE(change, 0);
    EXPECT_GE(change, last);
    last = change;
  }
  EXPECT_LT((momentum() - before).norm(), 1e-10);
}

TEST(TieVariants, RelaxationIsATime) {
  const auto left_after = [](double time_step, int steps, double relaxation) {
    Island island;
    const auto map = coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres);
    coupling::TieOptions options;
    options.relaxation_time = relaxation;
    coupling::Multipliers multipliers(map, island.masses(map), *island.nodes, options);
    for (int k = 0; k < steps; ++k) multipliers.apply({island.velocity.data(), 6}, *island.nodes, time_step);
    double sum = 0;
    for (std::size_t i = 0; i < map.elements.size(); ++i) {
      Vec3 gap = Vec3::Zero();
      for (int c = 0; c < 3; ++c)
        gap[c] = island.velocity[6 * static_cast<std::size_t>(map.elements[i]) + static_cast<std::size_t>(c)];
      for (coupling::RowMatrix::InnerIterator it(map.k, static_cast<Eigen::Index>(i)); it; ++it)
        gap -= it.value() *
               island.nodes->velocity[static_cast<std::size_t>(map.nodes[static_cast<std::size_t>(it.col())])];
      sum += gap.squaredNorm();
    }
    return std::sqrt(sum);
  };
  const double start = left_after(1e-6, 0, 20e-6);
  EXPECT_NEAR(left_after(1e-6, 20, 20e-6), std::pow(0.95, 20) * start, 1e-9 * start);
  EXPECT_NEAR(left_after(0.5e-6, 40, 20e-6), std::exp(-1) * start, 0.02 * start) << "whatever the step";
  EXPECT_NEAR(left_after(1e-6, 1, 0.5e-6), 0, 1e-11 * start) << "shorter than a step: strict";
}

TEST(TieVariants, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<double>> ends;
  for (const int threads : {1, 2, 3}) {
    Island island(some_turn());
    const auto map = coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres);
    coupling::TieOptions options;
    options.threads = threads;
    coupling::Multipliers multipliers(map, island.masses(map), *island.nodes, options);
    multipliers.apply({island.velocity.data(), 6}, *island.nodes, 1e-6);
    ends.push_back(island.velocity);
  }
  EXPECT_EQ(std::memcmp(ends[0].data(), ends[1].data(), ends[0].size() * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(ends[0].data(), ends[2].data(), ends[0].size() * sizeof(double)), 0);
}

TEST(Zone, WeightsShareTheMaterial) {
  const Island island(some_turn(), Vec3(1, -2, 3));
  for (const Vec3& x : island.centres) {
    const double s = island.zone.overlap_coordinate(x);
    const Vec3 local = (island.turn.transpose() * (x - island.shift)).cwiseAbs();
    EXPECT_NEAR(s, (local.maxCoeff() - 0.2) / 0.4, 1e-12);
    if (s > 0 && s < 1) {
      EXPECT_NEAR(island.zone.finite_weight(x) + island.zone.discrete_weight(x), 1, 1e-15);
    }
    if (s > 0.02 && s < 0.98) {
      EXPECT_NEAR(island.zone.finite_weight(x), s, 1e-12);
    }
    if (s <= 0) {
      EXPECT_EQ(island.zone.discrete_weight(x), 1);
    }
  }
  EXPECT_EQ(island.zone.finite_weight(island.shift + island.turn * Vec3(0.7, 0, 0)), 1);
  // The weighted mass of both together is that of the material: (hole + overlap + outside) once.
  const double share = island.body->total_mass() / 2500;
  double expected = 1.6 * 1.6 * 1.6 - 1.2 * 1.2 * 1.2;
  for (int k = 0; k < 4000; ++k) {  // integral of s over the cube's shells
    const double half = 0.2 + 0.4 * (k + 0.5) / 4000, s = (half - 0.2) / 0.4;
    expected += std::clamp(s, 0.02, 0.98) * 24 * half * half * (0.4 / 4000);
  }
  EXPECT_NEAR(share, expected, 0.005 * expected) << "8 Gauss points an element";
}

TEST(Zone, WeighsLinksByTheirWeakerEnd) {
  const std::vector<double> weights = {1, 0.5, 0.02};
  const std::vector<std::int32_t> a = {0, 1, 0}, b = {1, 2, 2};
  std::vector<double> area = {2, 3, 4};
  coupling::weigh_links(weights, a, b, area);
  EXPECT_THAT(area, testing::ElementsAre(1, 3 * 0.02, 4 * 0.02));
}

TEST(Coupling, RefusesWhatDoesNotFit) {
  using testing::HasSubstr;
  Island island;
  coupling::Zone zone = island.zone;
  zone.coupled.fill(false);
  EXPECT_THAT(refusal([&] { zone.validate(); }), HasSubstr("no face is coupled"));
  zone = island.zone;
  zone.thickness = 0.6;
  EXPECT_THAT(refusal([&] { zone.validate(); }), HasSubstr("leave nothing of its 1.2 m along axis 1"));
  zone = island.zone;
  zone.least_weight = 0;
  EXPECT_THAT(refusal([&] { zone.validate(); }), HasSubstr("least weight is 0"));
  zone = island.zone;
  zone.axes.col(0) *= 2;
  EXPECT_THAT(refusal([&] { zone.validate(); }), HasSubstr("axes"));

  zone = island.zone;  // a mesh with one layer only, where the overlap has two
  fe::BoxMeshOptions options;
  options.origin = Vec3::Constant(-0.8);
  options.size = Vec3::Constant(1.6);
  options.elements = {8, 8, 8};
  options.zone = fe::DiscreteZone{Vec3::Constant(-0.6), Vec3::Constant(0.6), 1};
  const fe::Mesh thin = fe::box_mesh(options);
  const fe::Body body(thin, {30e9, 0.2, 2500});
  EXPECT_THAT(refusal([&] { coupling::make_kinematic_map(zone, thin, body, island.centres); }),
              testing::AllOf(HasSubstr("lie in no finite element"), HasSubstr("surround the zone")));
  options.zone.reset();  // no hole
  const fe::Mesh full = fe::box_mesh(options);
  const fe::Body full_body(full, {30e9, 0.2, 2500});
  EXPECT_THAT(refusal([&] { coupling::make_kinematic_map(zone, full, full_body, island.centres); }),
              HasSubstr("lies where there are discrete elements alone"));
  options.size.x() = 1.4;  // ends at the zone's face
  options.elements[0] = 7;
  options.zone = fe::DiscreteZone{Vec3::Constant(-0.6), Vec3::Constant(0.6), 2};
  const fe::Mesh open = fe::box_mesh(options);
  const fe::Body open_body(open, {30e9, 0.2, 2500});
  EXPECT_THAT(refusal([&] { coupling::make_kinematic_map(zone, open, open_body, island.centres); }),
              testing::AllOf(HasSubstr("no finite element lies behind"), HasSubstr("surround the zone")));
  const std::vector<Vec3> one = {Vec3::Zero()};
  EXPECT_THAT(refusal([&] { coupling::make_kinematic_map(zone, island.mesh, *island.body, one); }),
              HasSubstr("no discrete element lies in the overlap"));

  const auto map = coupling::make_kinematic_map(island.zone, island.mesh, *island.body, island.centres,
                                                Ties::displacements_and_rotations);
  coupling::TieOptions both;
  both.solve = coupling::MultiplierSolve::lumped;
  EXPECT_THAT(refusal([&] { coupling::Multipliers(map, island.masses(map), *island.nodes, both); }),
              HasSubstr("lumped multipliers tie displacements only"));
  coupling::TieOptions backwards;
  backwards.relaxation_time = -1;
  EXPECT_THAT(refusal([&] { coupling::Multipliers(map, island.masses(map), *island.nodes, backwards); }),
              HasSubstr("relaxation time is -1 s"));
  EXPECT_THAT(refusal([&] { coupling::largest_interval(2e-5, 1e-5); }), HasSubstr("above 9e-06 s"));
  EXPECT_EQ(coupling::largest_interval(1e-6, 1e-5), 9);
}
