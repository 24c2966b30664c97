// Finite elements in equilibrium against closed forms, with the order at which they converge.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libdem/core/error.h"
#include "tests/verification/fe_scene.h"

using fe::Formulation;
using fe::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

/// Error of a cantilever's tip deflection against the elastic solution of Timoshenko and Goodier, relative. It
/// is exact in three dimensions at a Poisson ratio of 0: parabolic shear on the free end, the exact
/// displacement prescribed at the other.
double cantilever_error(int across, Formulation formulation) {
  const double length = 1.0, depth = 0.2, width = 0.1, force = 1e4;  // [m, N]
  const fe::Material material = fe_scene::concrete(0);
  const double inertia = width * std::pow(depth, 3) / 12,
               factor = force / (6 * material.young_modulus * inertia);
  const fe::Mesh mesh =
      fe_scene::box(Vec3(length, depth, width), {5 * across, across, 1}, Vec3(0, -depth / 2, 0));
  const auto exact = [&](const Vec3& p) {
    const double x = p.x(), y = p.y();
    return Vec3(-factor * y * ((6 * length - 3 * x) * x + 2 * (y * y - depth * depth / 4)),
                factor * (depth * depth * x + (3 * length - x) * x * x), 0);
  };
  const std::vector<Vec3> load = fe_scene::surface_load(
      mesh, [&](const Vec3& p) { return p.x() > length - 1e-9; },
      [&](const Vec3& p) { return Vec3(0, force / (2 * inertia) * (depth * depth / 4 - p.y() * p.y()), 0); });
  std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, false, false});
  std::vector<Vec3> prescribed(mesh.nodes.size(), Vec3::Zero());
  std::size_t tip = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].x() < 1e-9) held[i] = {true, true, true}, prescribed[i] = exact(mesh.nodes[i]);
    if ((mesh.nodes[i] - Vec3(length, 0, 0)).norm() < 1e-9) tip = i;
  }
  const fe::Body body(mesh, material, fe_scene::with(formulation));
  const fe::StaticSolution solution = fe::solve_static(body, load, held, prescribed);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) sum += solution.reaction[i];
  EXPECT_NEAR(sum.y(), -force, 1e-8 * force) << "the support carries the load";
  const double wanted = exact(Vec3(length, 0, 0)).y();
  return (solution.displacement[tip].y() - wanted) / wanted;
}

/// Middle deflection of a simply supported square plate under q sin(pi x/a) sin(pi y/a), times D/(q a^4). A
/// quarter is computed; u_y = u_z = 0 on the edge x = 0, and so on.
double plate_deflection(int across, int through, double side, double thickness, Formulation formulation) {
  const fe::Material material = fe_scene::concrete();
  const double half = side / 2, pressure = 1e4;
  const fe::Mesh mesh = fe_scene::box(Vec3(half, half, thickness), {across, across, through});
  const std::vector<Vec3> load = fe_scene::surface_load(
      mesh, [&](const Vec3& p) { return p.z() > thickness - 1e-9; },
      [&](const Vec3& p) {
        return Vec3(0, 0, -pressure * std::sin(pi * p.x() / side) * std::sin(pi * p.y() / side));
      });
  std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, false, false});
  std::size_t middle = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& p = mesh.nodes[i];
    if (p.x() < 1e-9) held[i][1] = held[i][2] = true;
    if (p.y() < 1e-9) held[i][0] = held[i][2] = true;
    if (p.x() > half - 1e-9) held[i][0] = true;
    if (p.y() > half - 1e-9) held[i][1] = true;
    if ((p - Vec3(half, half, thickness / 2)).norm() < 1e-9) middle = i;
  }
  const fe::Body body(mesh, material, fe_scene::with(formulation));
  const std::vector<Vec3> nothing(mesh.nodes.size(), Vec3::Zero());
  const double w = -fe::solve_static(body, load, held, nothing).displacement[middle].z();
  const double nu = material.poisson_ratio;
  const double rigidity = material.young_modulus * std::pow(thickness, 3) / (12 * (1 - nu * nu));
  return w * rigidity / (pressure * std::pow(side, 4));
}

/// The same of a square of side 1 and Poisson ratio 0.2 by three-dimensional elasticity: in-plane displacements
/// are the gradient of a potential, which leaves the plane-strain problem of wave number k = sqrt(2) pi; its
/// Airy function is F = B z cosh kz + C sinh kz, with F' = 0 and F = q/(2 k^2) at z = h/2.
double exact_plate_deflection(double thickness) {
  const double nu = 0.2, k = std::sqrt(2.0) * pi, c = thickness / 2, ch = std::cosh(k * c),
               sh = std::sinh(k * c);
  const double ratio = -(ch + k * c * sh) / (k * ch);  // C/B
  const double b = 1 / (2 * k * k) / (c * ch + ratio * sh);
  const double first = b * (1 + ratio * k), third = b * k * k * (3 + ratio * k);  // F'(0), F'''(0)
  const double shear_modulus = 1 / (2 * (1 + nu));                                // for E = 1, q = 1
  const double w = ((nu - 2) * first + (1 - nu) * third / (k * k)) / (2 * shear_modulus);
  return std::abs(w) * std::pow(thickness, 3) / (12 * (1 - nu * nu));
}

}  // namespace

TEST(Cantilever, ConvergesAtSecondOrder) {
  for (const Formulation formulation : {Formulation::trilinear, Formulation::incompatible_modes}) {
    const double coarse = cantilever_error(2, formulation), middle = cantilever_error(4, formulation),
                 fine = cantilever_error(8, formulation);
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.25);
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.15);
    EXPECT_LT(std::abs(fine), 0.01);
    RecordProperty(formulation == Formulation::trilinear ? "trilinear" : "incompatible_modes",
                   std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine));
  }
  EXPECT_LT(std::abs(cantilever_error(2, Formulation::incompatible_modes)), 0.02)
      << "two elements are enough to bend";
}

TEST(Plate, ConvergesAtSecondOrderToItsClosedForm) {
  const auto study = [](const char* name, Formulation formulation, double thickness, int across, int through,
                        double order_within, double fine_within) {
    const double closed = exact_plate_deflection(thickness);
    double error[3];
    for (int k = 0; k < 3; ++k)
      error[k] = plate_deflection(across << k, through << k, 1, thickness, formulation) / closed - 1;
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2, order_within) << name;
    EXPECT_LT(std::abs(error[2]), fine_within) << name;
    RecordProperty(name,
                   std::to_string(error[0]) + " " + std::to_string(error[1]) + " " + std::to_string(error[2]));
  };
  study("incompatible_modes_thin", Formulation::incompatible_modes, 0.05, 4, 2, 0.5, 0.002);
  study("incompatible_modes_thick", Formulation::incompatible_modes, 0.25, 4, 2, 0.1, 0.003);
  // Trilinear elements must be small against the thickness before their order shows.
  study("trilinear_thick", Formulation::trilinear, 0.25, 4, 2, 0.1, 0.01);
  // The closed form itself, against Navier's solution with Mindlin's shear deflection.
  const double navier = (1 + 2 * pi * pi * 0.01 * 0.01 / (5 * 0.8)) / (4 * std::pow(pi, 4));
  EXPECT_NEAR(exact_plate_deflection(0.01), navier, 1e-4 * navier);
}

TEST(StaticSolve, SaysThatSupportsAreMissing) {
  const fe::Mesh mesh = fe_scene::box(Vec3(1, 1, 1), {2, 2, 2});
  const fe::Body body(mesh, fe_scene::concrete());
  const std::vector<Vec3> zero(mesh.nodes.size(), Vec3::Zero());
  std::vector<fe::Held> held(mesh.nodes.size(), fe::Held{false, false, false});
  held[0] = {true, true, true};  // it can still turn about this node
  EXPECT_THROW(fe::solve_static(body, zero, held, zero), dem::RunError);
}
