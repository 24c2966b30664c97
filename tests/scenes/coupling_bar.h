// The bar of coupling_scene.h in motion: discrete elements alone, finite ones alone, or coupled.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>

#include "tests/scenes/coupling_scene.h"

namespace coupling_scene {

inline constexpr double element = 0.025;  // finite element [m]

/// A pack, its moduli, and the material of finite elements that has the same wave speeds.
struct Bar {
  double length, across, outer;  // outer: where discrete elements end in a coupled run [m]
  Pack pack;
  Network whole;
  double pressure_modulus = 0, shear_modulus = 0;
  fe::Material material;
  double time_step = 0;

  Bar(double wanted_length, double wanted_across, double wanted_outer)
      : length(wanted_length),
        across(wanted_across),
        outer(wanted_outer),
        pack(make_pack(Vec3(length, across, across), 0.01, 1)),
        whole(link(pack, false)) {
    Mat3 stretch = Mat3::Zero(), shear = Mat3::Zero();
    stretch(0, 0) = 1, shear(1, 0) = 1;
    pressure_modulus = modulus(pack, stretch);
    shear_modulus = modulus(pack, shear);
    const double mu = shear_modulus, lambda = pressure_modulus - 2 * mu;
    material = {mu * (3 * lambda + 2 * mu) / (lambda + mu), lambda / (2 * (lambda + mu)), 2500};
    time_step = 0.7 * 2 / whole.highest_frequency();
  }
  double speed(int axis) const {
    return std::sqrt((axis == 0 ? pressure_modulus : shear_modulus) / material.density);
  }
};

enum class From { discrete, finite };

struct BarOptions {
  int layers = 3;
  coupling::TieOptions tie;
  coupling::Ties ties = coupling::Ties::displacements;
  bool weighted = true;
  int interval = 1;
};

/// Everything that moves in one run: discrete elements below `outer`, finite ones beyond, or one of both
/// throughout.
struct BarRun {
  Network discrete;
  fe::Mesh mesh;
  std::optional<fe::Body> body;
  std::optional<fe::State> nodes;
  std::optional<coupling::Multipliers> ties;
  std::optional<coupling::SubStepping> sub_stepping;
  fe::ElementRows room;
  std::vector<double> push_discrete, push_nodes;  // share of the load by element, by node
  double time_step = 0;                           // [s]
  int axis = 0;
  std::int64_t step_number = 0;

  void step(double force) {
    const auto direction = static_cast<std::size_t>(axis);
    for (std::size_t i = 0; i < discrete.u.size(); ++i) discrete.u[i] += time_step * discrete.v[i];
    discrete.force(discrete.u, discrete.f);
    for (std::size_t i = 0; i < push_discrete.size(); ++i)
      discrete.f[6 * i + direction] += force * push_discrete[i];
    for (std::size_t i = 0; i < discrete.v.size(); ++i)
      discrete.v[i] += time_step * discrete.f[i] / discrete.mass[i / 6][i % 6];
    if (body) {
      fe::advance_positions(*nodes, time_step);
      sub_stepping->advance_velocities(*body, *nodes, step_number, time_step);
      for (std::size_t i = 0; i < push_nodes.size(); ++i)
        nodes->velocity[i][axis] += time_step * force * push_nodes[i] * nodes->inverse_mass[i][axis];
    }
    if (ties) ties->apply({discrete.v.data(), 6}, *nodes, time_step);
    ++step_number;
  }
};

inline void add_finite(BarRun& run, const Bar& bar, double from, const coupling::Zone* zone) {
  fe::BoxMeshOptions box;
  box.origin = Vec3(from, 0, 0);
  box.size = Vec3(bar.length - from, bar.across, bar.across);
  for (int k = 0; k < 3; ++k)
    box.elements[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(box.size[k] / element));
  run.mesh = fe::box_mesh(box);
  fe::BodyOptions options;
  options.representative = periodic_across(run.mesh, Vec3(bar.length, bar.across, bar.across));
  if (zone != nullptr) options.weights = coupling::finite_weights(*zone, run.mesh);
  run.body.emplace(run.mesh, bar.material, options);
  run.nodes.emplace(*run.body);
  run.sub_stepping.emplace(*run.body, coupling::KinematicMap{}, 1);
}

inline coupling::Zone zone_of(const Bar& bar, const BarOptions& options) {
  coupling::Zone zone;
  zone.half_size = Vec3(bar.outer / 2, bar.across / 2, bar.across / 2);
  zone.centre = zone.half_size;
  zone.coupled = {false, true, false, false, false, false};
  zone.thickness = options.layers * element;
  return zone;
}

inline BarRun coupled_run(const Bar& bar, const BarOptions& options) {
  const coupling::Zone zone = zone_of(bar, options);
  BarRun run;
  std::vector<std::size_t> number(bar.pack.centres.size(), SIZE_MAX);
  const Network& whole = bar.whole;
  std::vector<double> weight;
  for (std::size_t i = 0; i < whole.centres.size(); ++i) {
    if (whole.centres[i].x() >= bar.outer) continue;
    number[i] = run.discrete.centres.size();
    run.discrete.centres.push_back(whole.centres[i]);
    weight.push_back(options.weighted ? zone.discrete_weight(whole.centres[i]) : 1);
    run.discrete.mass.push_back(whole.mass[i]);
    for (double& m : run.discrete.mass.back()) m *= weight.back();
  }
  for (Network::Spring s : whole.springs) {
    if (number[s.a] == SIZE_MAX || number[s.b] == SIZE_MAX) continue;
    s.a = number[s.a], s.b = number[s.b];
    const double w = std::min(weight[s.a], weight[s.b]);
    s.normal_stiffness *= w, s.shear_stiffness *= w;
    run.discrete.springs.push_back(s);
  }
  run.discrete.clear_motion();
  add_finite(run, bar, bar.outer - zone.thickness, options.weighted ? &zone : nullptr);
  const coupling::KinematicMap map =
      coupling::make_kinematic_map(zone, run.mesh, *run.body, run.discrete.centres, options.ties);
  coupling::DiscreteMasses masses;
  for (const std::int32_t i : map.elements)
    masses.row.push_back(run.discrete.mass[static_cast<std::size_t>(i)]);
  run.ties.emplace(map, masses, *run.nodes, options.tie);
  run.sub_stepping.emplace(*run.body, map, options.interval);
  run.time_step = bar.time_step;
  return run;
}

/// Shares of the load, by mass, at the end that the pulse starts from.
inline void push(BarRun& run, const Bar& bar, From from) {
  double sum = 0;
  if (from == From::discrete) {
    for (std::size_t i = 0; i < run.discrete.centres.size(); ++i)
      run.push_discrete.push_back(run.discrete.centres[i].x() < 0.02 ? run.discrete.mass[i][0] : 0);
    for (const double m : run.push_discrete) sum += m;
    for (double& m : run.push_discrete) m /= sum;
  } else {
    for (std::size_t i = 0; i < run.mesh.nodes.size(); ++i)
      run.push_nodes.push_back(run.mesh.nodes[i].x() > bar.length - 1e-9 ? run.nodes->mass[i] : 0);
    for (const double m : run.push_nodes) sum += m;
    for (double& m : run.push_nodes) m /= sum;
  }
}

/// A push of one hump that lasts `duration`.
inline double hump(double time, double duration) {
  return time < duration ? 0.5 * (1 - std::cos(2 * std::numbers::pi * time / duration)) : 0;
}

/// Elastic energy of the springs that join elements below `below`, and kinetic energy 1/2 m v.w of those
/// elements.
inline double energy(const Network& net, const std::vector<double>& u, const std::vector<double>& v,
                     const std::vector<double>& w, double below = 1e300) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (net.centres[i / 6].x() < below) sum += 0.5 * net.mass[i / 6][i % 6] * v[i] * w[i];
  for (const Network::Spring& s : net.springs)
    if (net.centres[s.a].x() < below && net.centres[s.b].x() < below)
      sum += 0.5 * Network::pull(s, Network::opening(s, u)).dot(Network::opening(s, u));
  return sum;
}

}  // namespace coupling_scene
