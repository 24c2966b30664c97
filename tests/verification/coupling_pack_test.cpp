// The coupling on a real pack, stepped by libdem: a beam whose right part is finite elements against the same
// beam of discrete elements alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "impact/coupling/discrete_side.h"
#include "impact/coupling/sub_stepping.h"
#include "impact/fe/box_mesh.h"
#include "impact/fe/critical_step.h"
#include "libdem/motion/critical_step.h"
#include "libdem/probe/energy.h"
#include "libdem/run/step.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/setup.h"
#include "tests/verification/scene.h"

namespace {

using dem::Vec3;

constexpr double length = 0.8, across = 0.1, outer = 0.5, element = 0.025;  // [m]

/// A beam of discrete elements, elastic, and its static moduli.
struct Beam {
  specimens::Specimen pack;
  dem::MaterialCard card;
  fe::Material material;
  double time_step = 0;

  Beam() {
    specimens::PackingOptions packing;
    packing.size = Vec3(length, across, across);
    packing.elements = 4096;
    packing.threads = 1;
    pack = specimens::pack(packing);
    specimens::link(pack, 1);
    card.tensile_strength = card.cohesion = 1e15;
    const auto moduli = virtual_tests::run_elastic(pack, card);
    material = {moduli.young_modulus, moduli.poisson_ratio, card.density};
    time_step = 0.7 * scene::critical_step_of(virtual_tests::make_assembly(pack, card));
  }

  /// The elements left of `outer`, with the links among them; masses are those of the whole beam.
  dem::Assembly left() const {
    const dem::Assembly whole = virtual_tests::make_assembly(pack, card);
    std::vector<std::int32_t> number(pack.elements(), -1);
    specimens::Specimen part = pack;
    part.centres.clear(), part.radii.clear(), part.links.clear();
    double mass = 0;
    for (std::size_t i = 0; i < pack.elements(); ++i) {
      if (pack.centres[i].x() >= outer) continue;
      number[i] = static_cast<std::int32_t>(part.centres.size());
      part.centres.push_back(pack.centres[i]), part.radii.push_back(pack.radii[i]);
      mass += whole.particles.element_mass(i);
    }
    for (specimens::Link link : pack.links) {
      link.a = number[static_cast<std::size_t>(link.a)], link.b = number[static_cast<std::size_t>(link.b)];
      if (link.a >= 0 && link.b >= 0) part.links.push_back(link);
    }
    return {
        dem::Particles(part.centres, part.radii, mass), dem::make_links(part.links, part.radii), {}, whole.law};
  }
};

const Beam& beam() {
  static const Beam made;
  return made;
}

/// Sets the left end going, with `push` at its face [m/s].
void kick(dem::Particles& particles, const Vec3& push) {
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double x = particles.initial_position[i].x();
    particles.set_velocity(i, push * std::exp(-std::pow(x / 0.1, 2)));
  }
}

/// Mean displacement of a slice of discrete elements at x [m].
Vec3 slice(const dem::Particles& particles, double x) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < particles.count; ++i)
    if (std::abs(particles.initial_position[i].x() - x) < 0.0125) {
      sum += particles.element_mass(i) * particles.displacement(i);
      mass += particles.element_mass(i);
    }
  return sum / mass;
}

}  // namespace

TEST(CoupledBeam, MovesAsTheBeamOfDiscreteElementsAlone) {
  // Off its axis: a wave along the beam and bending at once. Both ends are free.
  const Vec3 push(0.01, 0, 0.01);
  dem::Assembly plain = virtual_tests::make_assembly(beam().pack, beam().card);
  kick(plain.particles, push);

  dem::Assembly discrete = beam().left();
  kick(discrete.particles, push);
  coupling::Zone zone;
  zone.half_size = Vec3(outer, across, across) / 2;
  zone.centre = zone.half_size;
  zone.coupled = {false, true, false, false, false, false};
  zone.thickness = 4 * element;
  fe::BoxMeshOptions box;
  box.origin = Vec3(outer - zone.thickness, 0, 0);
  box.size = Vec3(length - outer + zone.thickness, across, across);
  box.elements = {16, 4, 4};
  const fe::Mesh mesh = fe::box_mesh(box);
  fe::BodyOptions weighted;
  weighted.weights = coupling::finite_weights(zone, mesh);
  const fe::Body body(mesh, beam().material, weighted);
  fe::State nodes(body);
  coupling::weigh(zone, discrete.particles, discrete.links);
  const auto map = coupling::make_kinematic_map(zone, mesh, body, discrete.particles.initial_position);
  coupling::Multipliers multipliers(map, coupling::tied_masses(map, discrete.particles), nodes);
  const double dt = beam().time_step;
  coupling::SubStepping sub_stepping(body, map, coupling::largest_interval(dt, fe::critical_time_step(body)));
  EXPECT_GE(sub_stepping.interval(), 2);

  dem::StepRoom plain_room(plain), room(discrete);
  dem::StepOptions options;
  options.time_step = dt;
  const auto end_nodes = fe::nodes_in_box(mesh, Vec3(length - 1e-6, 0, 0), Vec3(length + 1e-6, across, across));
  double worst = 0, squares = 0, highest = 0;
  Vec3 momentum_before = Vec3::Zero(), momentum_after = Vec3::Zero();
  for (std::size_t i = 0; i < discrete.particles.count; ++i)
    momentum_before += discrete.particles.element_mass(i) * discrete.particles.kinematics[i].velocity();
  const int steps = 2500;
  int samples = 0;
  for (int n = 0; n < steps; ++n) {
    dem::advance(plain, plain_room, options);
    dem::advance(discrete, room, options);
    fe::advance_positions(nodes, dt);
    sub_stepping.advance_velocities(body, nodes, n, dt);
    const coupling::TieSums sums = multipliers.apply(coupling::velocities(discrete.particles), nodes, dt);
    room.max_speed = std::max(room.max_speed, std::sqrt(sums.max_speed_squared));
    if (n % 20 != 0) continue;
    Vec3 end = Vec3::Zero();
    for (const std::int32_t node : end_nodes)
      end += nodes.displacement[static_cast<std::size_t>(node)] / static_cast<double>(end_nodes.size());
    // The last slice of discrete elements lies half its thickness inside, where the rigid part of the motion is
    // the same.
    for (const auto& [coupled, alone] : {std::pair(slice(discrete.particles, 0.2), slice(plain.particles, 0.2)),
                                         std::pair(end, slice(plain.particles, length - 0.00625))}) {
      worst = std::max(worst, (coupled - alone).norm());
      squares += (coupled - alone).squaredNorm();
      highest = std::max(highest, alone.norm());
      ++samples;
    }
  }
  for (std::size_t i = 0; i < discrete.particles.count; ++i)
    momentum_after += discrete.particles.element_mass(i) * discrete.particles.kinematics[i].velocity();
  momentum_after += fe::momentum(nodes);
  EXPECT_LT((momentum_after - momentum_before).norm(), 1e-9 * momentum_before.norm());
  const double rms = std::sqrt(squares / samples) / highest;
  EXPECT_LT(rms, 0.03) << "of the highest displacement";
  EXPECT_LT(worst / highest, 0.08);
  RecordProperty("rms", std::to_string(rms));
  RecordProperty("worst", std::to_string(worst / highest));
  RecordProperty("interval", sub_stepping.interval());
}

namespace {

/// A cube of discrete elements with finite elements all round, turned and shifted as a whole.
struct Island {
  fe::Mesh mesh;
  dem::Assembly discrete;
  coupling::Zone zone;
  std::optional<fe::Body> body;
  std::optional<fe::State> nodes;
  std::optional<coupling::Multipliers> multipliers;
  std::optional<coupling::SubStepping> sub_stepping;
  std::optional<dem::StepRoom> room;
  dem::StepOptions options;
  std::int64_t steps = 0;
  std::vector<dem::Kinematics> before;
  std::vector<Vec3> nodes_before;

  Island(const specimens::Specimen& cube, const dem::MaterialCard& card, const fe::Material& material,
         const dem::Mat3& turn, const Vec3& shift)
      : discrete(virtual_tests::make_assembly(cube, card)) {
    const double half = cube.size.x() / 2;  // four finite elements
    specimens::Specimen turned = cube;
    for (Vec3& centre : turned.centres) centre = turn * (centre - Vec3::Constant(half)) + shift;
    discrete = virtual_tests::make_assembly(turned, card);
    fe::BoxMeshOptions box;
    box.origin = Vec3::Constant(-2 * half), box.size = Vec3::Constant(4 * half), box.elements = {16, 16, 16};
    box.zone = fe::DiscreteZone{Vec3::Constant(-half), Vec3::Constant(half), 2};
    mesh = fe::box_mesh(box);
    for (Vec3& node : mesh.nodes) node = turn * node + shift;
    zone.centre = shift, zone.axes = turn, zone.half_size = Vec3::Constant(half), zone.thickness = half / 2;
    zone.coupled.fill(true);
    fe::BodyOptions weighted;
    weighted.weights = coupling::finite_weights(zone, mesh);
    body.emplace(mesh, material, weighted);
    nodes.emplace(*body);
    options.time_step = 0.6 * scene::critical_step_of(discrete);
    coupling::weigh(zone, discrete.particles, discrete.links);
    const auto map = coupling::make_kinematic_map(zone, mesh, *body, discrete.particles.initial_position);
    multipliers.emplace(map, coupling::tied_masses(map, discrete.particles), *nodes);
    sub_stepping.emplace(*body, map, 1);
    for (std::size_t i = 0; i < discrete.particles.count; ++i) {
      const Vec3 local = turn.transpose() * (discrete.particles.initial_position[i] - shift);
      discrete.particles.set_velocity(i,
                                      turn * Vec3(0.01, 0.02, -0.01) * std::exp(-local.squaredNorm() / 0.0064));
    }
    room.emplace(discrete);
  }

  void step() {
    before.assign(discrete.particles.kinematics.begin(), discrete.particles.kinematics.end());
    nodes_before = nodes->velocity;
    dem::advance(discrete, *room, options);
    fe::advance_positions(*nodes, options.time_step);
    sub_stepping->advance_velocities(*body, *nodes, steps++, options.time_step);
    const auto sums = multipliers->apply(coupling::velocities(discrete.particles), *nodes, options.time_step);
    room->max_speed = std::max(room->max_speed, std::sqrt(sums.max_speed_squared));
  }
  /// Of both domains, at the time of the last step [J].
  double energy() {
    dem::settle(discrete, *room);
    double sum = dem::pair_energy(discrete.law, discrete.particles, discrete.links).elastic;
    for (std::size_t i = 0; i < discrete.particles.count; ++i) {
      const dem::Kinematics& now = discrete.particles.kinematics[i];
      sum += 0.5 * (discrete.particles.element_mass(i) * before[i].velocity().dot(now.velocity()) +
                    discrete.particles.element_inertia(i) * before[i].spin().dot(now.spin()));
    }
    fe::State state = *nodes;
    fe::ElementRows rows;
    fe::internal_force(*body, state, rows);
    sum += fe::elastic_energy(state);
    for (std::size_t j = 0; j < nodes_before.size(); ++j)
      sum += 0.5 * state.mass[j] * nodes_before[j].dot(state.velocity[j]);
    return sum;
  }
};

}  // namespace

TEST(CoupledIsland, KeepsItsEnergyAndIsTheSameInAnyOrientation) {
  specimens::PackingOptions packing;
  packing.size = Vec3::Constant(0.4);
  packing.elements = 4096;
  packing.threads = 1;
  specimens::Specimen cube = specimens::pack(packing);
  specimens::link(cube, 1);
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e15;
  const fe::Material material{30e9, 0.2, card.density};
  const dem::Mat3 turn = Eigen::AngleAxisd(0.6, Vec3(1, -2, 0.7).normalized()).toRotationMatrix();
  const Vec3 shift(0.3, -0.5, 0.2);
  Island plain(cube, card, material, dem::Mat3::Identity(), Vec3::Zero());
  Island turned(cube, card, material, turn, shift);
  // The first ties take out what the initial velocities violate.
  for (int n = 0; n < 21; ++n) plain.step(), turned.step();
  const double first = plain.energy();
  for (int n = 0; n < 400; ++n) plain.step(), turned.step();
  EXPECT_NEAR(plain.energy(), first, 1e-6 * first);
  RecordProperty("energy_drift_ppm", std::to_string(1e6 * (plain.energy() / first - 1)));
  double highest = 0, apart = 0;
  for (std::size_t j = 0; j < plain.nodes->nodes(); ++j) {
    highest = std::max(highest, plain.nodes->displacement[j].norm());
    apart = std::max(apart, (turn * plain.nodes->displacement[j] - turned.nodes->displacement[j]).norm());
  }
  EXPECT_GT(highest, 0);
  EXPECT_LT(apart, 1e-6 * highest);
}
