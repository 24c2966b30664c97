// Finite elements in motion: frequencies and wave speeds against closed forms, energy, momentum, the critical
// step, the same bits on any number of threads.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstring>
#include <numbers>

#include "impact/fe/critical_step.h"
#include "impact/fe/motion.h"
#include "tests/verification/fe_scene.h"

using fe::Formulation;
using fe::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

/// Angular frequencies of the free degrees of freedom, ascending [rad/s].
Eigen::VectorXd frequencies(const fe::Body& body, const std::vector<fe::Held>& held) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < body.nodes(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (!held[i][c]) free.push_back(static_cast<Eigen::Index>(3 * i + c));
  const Eigen::MatrixXd whole(fe::assemble(body));
  Eigen::MatrixXd scaled = whole(free, free);
  Eigen::VectorXd root(scaled.rows());
  for (Eigen::Index k = 0; k < scaled.rows(); ++k)
    root[k] = 1 / std::sqrt(body.node_mass[static_cast<std::size_t>(free[static_cast<std::size_t>(k)] / 3)]);
  scaled = root.asDiagonal() * scaled * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(0)
      .cwiseSqrt();
}

/// First axial frequency of a bar free at both ends, over pi c/L; at a Poisson ratio of 0 this is exact.
double axial_ratio(int elements) {
  const fe::Material material = fe_scene::concrete(0);
  const fe::Mesh mesh = fe_scene::box(Vec3(1, 0.1, 0.1), {elements, 1, 1});
  const std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, true, true});
  const Eigen::VectorXd omega = frequencies(fe::Body(mesh, material), held);
  return omega[1 + 0] / (pi * std::sqrt(material.young_modulus / material.density));
}

/// First bending frequency of a simply supported beam over Timoshenko's.
double bending_ratio(int along, int across, Formulation formulation) {
  const double length = 1, depth = 0.1;
  const fe::Material material = fe_scene::concrete(0);
  const fe::Mesh mesh = fe_scene::box(Vec3(length, 0.05, depth), {along, 1, across});
  std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, true, false});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].x() < 1e-9 || mesh.nodes[i].x() > length - 1e-9) held[i][2] = true;
  const Eigen::VectorXd omega = frequencies(fe::Body(mesh, material, fe_scene::with(formulation)), held);
  // EI k^4 - rho A w^2 (1 + r^2 k^2 (1 + E/(kappa mu))) + rho^2 A r^2/(kappa mu) w^4 = 0, over rho A.
  const double k = pi / length, r2 = depth * depth / 12, e = material.young_modulus / material.density;
  const double kmu = 0.85 * material.shear_modulus() / material.density;  // kappa for a Poisson ratio of 0
  const double a = r2 / kmu, b = 1 + r2 * k * k * (1 + e / kmu), c = e * r2 * std::pow(k, 4);
  const double closed = std::sqrt((b - std::sqrt(b * b - 4 * a * c)) / (2 * a));
  return omega[1] / closed;  // omega[0] is the free shift along x
}

/// Speed of the crest of a pulse that moves along `axis` in a bar whose other degrees of freedom are locked.
double pulse_speed(int axis) {
  const fe::Material material = fe_scene::concrete();
  const int elements = 400;
  const double length = 4, width = 0.12;
  const fe::Mesh mesh = fe_scene::box(Vec3(length, 0.01, 0.01), {elements, 1, 1});
  const fe::Body body(mesh, material);
  fe::State state(body);
  std::vector<std::int32_t> all(body.nodes());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
  for (int k = 0; k < 3; ++k)
    if (k != axis) state.lock(all, k);
  // Velocity without displacement at one end: half a bell is its own mirror image, and a bell half as high
  // leaves.
  for (std::size_t i = 0; i < body.nodes(); ++i)
    state.velocity[i][axis] = std::exp(-std::pow(mesh.nodes[i].x() / width, 2));
  const double dt = 0.8 * fe::critical_time_step(body);
  const double expected = axis == 0 ? material.pressure_wave_speed() : material.shear_wave_speed();
  const double from = 1, to = 3;
  fe::ElementRows room;
  double time = 0;
  std::array<double, 2> passed{};
  for (std::size_t station = 0; station < 2; ++station) {
    const double until = ((station == 0 ? from : to)) / expected;
    while (time + dt / 2 < until) {
      fe::advance_positions(state, dt);
      fe::internal_force(body, state, room);
      fe::advance_velocities(state, dt);
      time += dt;
    }
    double weight = 0, place = 0;
    for (std::size_t i = 0; i < body.nodes(); ++i) {
      const double v = state.velocity[i][axis];
      if (v > 0.2) weight += v * v, place += v * v * mesh.nodes[i].x();
    }
    passed[station] = place / weight - expected * time;
  }
  return expected * (1 + (passed[1] - passed[0]) / (to - from)) / expected;
}

}  // namespace

TEST(AxialMode, ConvergesAtSecondOrder) {
  const double coarse = axial_ratio(8) - 1, middle = axial_ratio(16) - 1, fine = axial_ratio(32) - 1;
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.05);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.02);
  // The lumped bar's own dispersion: omega = 2 c/h sin(k h/2).
  EXPECT_NEAR(fine, std::sin(pi / 64) / (pi / 64) - 1, 1e-9);
}

TEST(BendingMode, HasTimoshenkosFrequency) {
  EXPECT_NEAR(bending_ratio(40, 4, Formulation::incompatible_modes), 1, 0.003);
  EXPECT_NEAR(bending_ratio(20, 2, Formulation::incompatible_modes), 1, 0.01);
  const double coarse = bending_ratio(10, 1, Formulation::trilinear) - 1,
               middle = bending_ratio(20, 2, Formulation::trilinear) - 1,
               fine = bending_ratio(40, 4, Formulation::trilinear) - 1;
  EXPECT_GT(coarse, 0.1) << "what the incompatible modes are for";
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.3);
}

TEST(Waves, TravelAtTheSpeedsOfTheContinuum) {
  EXPECT_NEAR(pulse_speed(0), 1, 0.002);  // P
  EXPECT_NEAR(pulse_speed(1), 1, 0.002);  // S
}

TEST(ExplicitRun, KeepsEnergyAndMomentum) {
  const fe::Mesh mesh = fe_scene::distorted(fe_scene::box(Vec3(0.4, 0.3, 0.2), {4, 3, 2}), 0.02);
  const fe::Body body(mesh, fe_scene::concrete());
  fe::State state(body);
  dem::Random random(9);
  for (Vec3& v : state.velocity) v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const double dt = 0.9 * fe::critical_time_step(body);
  const Vec3 before = fe::momentum(state);
  fe::ElementRows room;
  double first = 0, drift = 0;
  for (int step = 0; step < 20000; ++step) {
    fe::advance_positions(state, dt);
    fe::internal_force(body, state, room);
    const std::vector<Vec3> earlier = state.velocity;
    fe::advance_velocities(state, dt);
    double energy = fe::elastic_energy(state);  // with 1/2 m v(-).v(+) the leapfrog keeps it exactly
    for (std::size_t i = 0; i < body.nodes(); ++i)
      energy += 0.5 * state.mass[i] * earlier[i].dot(state.velocity[i]);
    if (step == 0) first = energy;
    drift = std::max(drift, std::abs(energy - first));
  }
  EXPECT_LT(drift, 1e-9 * first);
  EXPECT_LT((fe::momentum(state) - before).norm(), 1e-8 * body.total_mass());
}

TEST(ExplicitRun, GivesTheSameBitsOnAnyNumberOfThreads) {
  const fe::Mesh mesh = fe_scene::distorted(fe_scene::box(Vec3(1, 0.8, 0.5), {12, 10, 6}), 0.01);
  const fe::Body body(mesh, fe_scene::concrete());
  const double dt = 0.9 * fe::critical_time_step(body);
  std::vector<fe::State> ends;
  for (const int threads : {1, 2, 3}) {
    fe::State state(body);
    state.lock(fe::nodes_in_box(mesh, Vec3(0, 0, 0), Vec3(0, 0.8, 0.5)), 0);
    for (std::size_t i = 0; i < body.nodes(); ++i)
      state.velocity[i] = Vec3(std::sin(7.0 * static_cast<double>(i)), 0.1, 0);
    fe::ElementRows room;
    for (int step = 0; step < 50; ++step) {
      fe::advance_positions(state, dt, threads);
      fe::internal_force(body, state, room, threads);
      fe::advance_velocities(state, dt, threads);
    }
    ends.push_back(state);
  }
  for (std::size_t k = 1; k < ends.size(); ++k) {
    EXPECT_EQ(
        std::memcmp(ends[0].displacement.data(), ends[k].displacement.data(), body.nodes() * sizeof(Vec3)), 0);
    EXPECT_EQ(std::memcmp(ends[0].velocity.data(), ends[k].velocity.data(), body.nodes() * sizeof(Vec3)), 0);
  }
}

TEST(Supports, HoldWhatIsLocked) {
  const fe::Mesh mesh = fe_scene::box(Vec3(1, 0.2, 0.2), {10, 2, 2});
  const fe::Body body(mesh, fe_scene::concrete());
  fe::State state(body);
  const auto end = fe::nodes_in_box(mesh, Vec3(0, 0, 0), Vec3(0, 0.2, 0.2));
  ASSERT_EQ(end.size(), 9u);
  for (const int axis : {0, 1, 2}) state.lock(end, axis);
  for (std::size_t i = 0; i < body.nodes(); ++i)
    if (mesh.nodes[i].x() > 0) state.velocity[i] = Vec3(0.1, 0.2, -0.1);
  const double dt = 0.9 * fe::critical_time_step(body);
  fe::ElementRows room;
  for (int step = 0; step < 500; ++step) {
    fe::advance_positions(state, dt);
    fe::internal_force(body, state, room);
    fe::advance_velocities(state, dt);
  }
  for (const std::int32_t node : end)
    EXPECT_EQ(state.displacement[static_cast<std::size_t>(node)], Vec3::Zero());
  EXPECT_GT(state.displacement.back().norm(), 0);
}

TEST(CriticalStep, BoundsTheLargestStableOne) {
  for (const Formulation formulation : {Formulation::trilinear, Formulation::incompatible_modes}) {
    const fe::Mesh even = fe_scene::box(Vec3(0.8, 0.8, 0.8), {8, 8, 8});
    const fe::Body regular(even, fe_scene::concrete(), fe_scene::with(formulation));
    EXPECT_LE(fe::critical_time_step(regular), 2 / fe::highest_frequency(regular));
    EXPECT_GT(fe::critical_time_step(regular), 0.8 * 2 / fe::highest_frequency(regular));
    const fe::Mesh mesh = fe_scene::distorted(even, 0.02, 3);
    const fe::Body body(mesh, fe_scene::concrete(), fe_scene::with(formulation));
    const double safe = fe::critical_time_step(body), exact = 2 / fe::highest_frequency(body);
    EXPECT_LE(safe, exact);
    EXPECT_GT(safe, 0.6 * exact);
    const auto grows = [&](double dt) {
      fe::State state(body);
      dem::Random random(1);
      for (Vec3& v : state.velocity)
        v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double start = fe::kinetic_energy(state);
      fe::ElementRows room;
      for (int step = 0; step < 3000; ++step) {
        fe::advance_positions(state, dt);
        fe::internal_force(body, state, room);
        fe::advance_velocities(state, dt);
      }
      return !(fe::kinetic_energy(state) < 100 * start);
    };
    EXPECT_FALSE(grows(0.999 * exact));
    EXPECT_TRUE(grows(1.01 * exact));
  }
}

TEST(PeriodicNodes, MoveAsOne) {
  // A bar closed to a ring: a pulse leaves at one end and enters at the other, and nothing is lost.
  const fe::Mesh mesh = fe_scene::box(Vec3(1, 0.1, 0.1), {10, 1, 1});
  fe::BodyOptions options;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const bool last = mesh.nodes[i].x() > 1 - 1e-9;
    options.representative.push_back(static_cast<std::int32_t>(last ? i % 4 : i));
  }
  const fe::Body ring(mesh, fe_scene::concrete(), options);
  EXPECT_NEAR(ring.total_mass(), 2500 * 0.01, 1e-12);
  for (std::size_t i = 0; i < ring.nodes(); ++i)
    EXPECT_NEAR(ring.node_mass[i], mesh.nodes[i].x() > 1 - 1e-9 ? 0 : 2500 * 0.01 / 40, 1e-12);
}
