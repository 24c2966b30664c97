// Small assemblies for the verification tests: a scene takes two lines to set up and one call to step.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "libdem/core/random.h"
#include "libdem/core/vector.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/motion/critical_step.h"
#include "libdem/probe/energy.h"
#include "libdem/run/step.h"
#include "libdem/statics/link_network.h"

namespace scene {

using dem::Vec3;

/// A law in round numbers. The yield strain is 7.5e-5; Ks/Kn is 0.3.
inline dem::LinkLaw plain_law() {
  dem::LinkLaw law;
  law.normal_modulus = 40e9;
  law.shear_ratio = 0.3;
  law.tensile_strength = 3e6;
  law.cohesion = 4e6;
  law.softening = 5;
  law.internal_slope = std::tan(0.3);
  law.contact_slope = std::tan(0.2);
  return law;
}

/// The same, but nothing yields and nothing slides.
inline dem::LinkLaw elastic_law() {
  dem::LinkLaw law = plain_law();
  law.tensile_strength = law.cohesion = 1e15;
  return law;
}

/// The same law with moments: all of its numbers at work.
inline dem::LinkLaw with_moments(dem::LinkLaw law) {
  law.transfers_moments = true;
  law.slip_softening = 4;
  law.moment = {
      .rolling_stiffness = 0.25, .rolling_limit = 0.5, .twisting_stiffness = 0.1, .twisting_limit = 0.2};
  return law;
}

/// An assembly with its room and its ledger.
struct Scene {
  dem::Assembly assembly;
  dem::StepRoom room;
  dem::StepOptions options;
  double sliding = 0, damped = 0,
         kinetic = 0;  ///< the ledger's accumulated parts, and the last kinetic energy [J]

  Scene(dem::Assembly made, double time_step) : assembly(std::move(made)), room(assembly) {
    options.time_step = time_step;
    options.all_forces = true;
  }

  dem::Particles& particles() { return assembly.particles; }
  void step() {
    const dem::StepSums sums = dem::advance(assembly, room, options);
    dem::settle(assembly, room);
    sliding += sums.sliding, damped += sums.damped, kinetic = sums.kinetic;
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k) step();
  }
  Vec3 force(std::size_t i) const {
    const double* f = assembly.particles.force[i].value;
    return {f[0], f[1], f[2]};
  }
  Vec3 moment(std::size_t i) const {
    const double* f = assembly.particles.force[i].value;
    return {f[3], f[4], f[5]};
  }
  Vec3 position(std::size_t i) const { return assembly.particles.kinematics[i].position(); }
  /// Energy of links and contacts together.
  dem::PairEnergy energy() const {
    const dem::PairEnergy links = dem::pair_energy(assembly.law, assembly.particles, assembly.links);
    const dem::PairEnergy contacts = dem::pair_energy(assembly.law, assembly.particles, assembly.contacts);
    return {links.elastic + contacts.elastic, links.softening + contacts.softening};
  }
  /// Gives element i a prescribed motion in all six degrees of freedom.
  void hold(std::size_t i, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
    for (int c = 0; c < 3; ++c) {
      particles().prescribe(i, c, velocity[c]);
      particles().prescribe(i, c + 3, spin[c]);
    }
    room.max_speed = std::max(room.max_speed, velocity.norm());
  }
};

inline dem::Assembly assemble(const std::vector<Vec3>& centres, const std::vector<double>& radii,
                              const std::vector<dem::LinkGeometry>& links, const dem::LinkLaw& law,
                              double mass) {
  return {dem::Particles(centres, radii, mass), dem::make_links(links, radii), {}, law};
}

/// Two spheres on the x axis, a at the origin with a radius of 50 mm, b with 40 mm; D_init is 100 mm, 10 mm
/// more than the radii. S_int = pi (40 mm)^2.
struct Pair : Scene {
  static constexpr double ra = 0.05, rb = 0.04, distance = 0.1;
  static constexpr double area = std::numbers::pi * rb * rb;

  explicit Pair(const dem::LinkLaw& law, bool linked = true, double apart = distance)
      : Scene(assemble(
                  {Vec3::Zero(), Vec3(apart, 0, 0)}, {ra, rb},
                  linked ? std::vector<dem::LinkGeometry>{{0, 1, distance}} : std::vector<dem::LinkGeometry>{},
                  law, 2.0),
              1e-6) {
    hold(0), hold(1);
  }
  double kn() const { return assembly.law.normal_modulus * area / distance; }
  double ks() const { return assembly.law.shear_ratio * kn(); }
  double gap() const { return (position(1) - position(0)).norm(); }
  double strain() const { return gap() / distance - 1; }
  /// F_n on the link's axis, compression positive [N].
  double normal() const { return force(1).dot((position(1) - position(0)).normalized()); }
  /// F_s, what a feels across the axis [N].
  Vec3 shear() const {
    const Vec3 n = (position(1) - position(0)).normalized(), f = force(0);
    return f - f.dot(n) * n;
  }
  /// Moves b by `way` in equal steps, calls `watch` after each. Returns the work done on b [J], by trapezia.
  template <class Watch>
  double move(const Vec3& way, int count, Watch&& watch) {
    const Vec3 each = way / count;
    double work = 0;
    hold(1, each / options.time_step);
    for (int k = 0; k < count; ++k) {
      const Vec3 before = force(1);
      step();
      work -= 0.5 * (before + force(1)).dot(each);
      watch();
    }
    hold(1);
    return work;
  }
  double move(const Vec3& way, int count = 100) {
    return move(way, count, [] {});
  }
  /// Moves b along x until the link's strain is `strain`.
  double stretch_to(double target, int count = 100) {
    return move(Vec3((1 + target) * distance - gap(), 0, 0), count);
  }
};

/// Equal spheres that touch, on the x axis.
inline dem::Assembly chain(int count, const dem::LinkLaw& law, double radius = 0.01) {
  std::vector<Vec3> centres;
  std::vector<dem::LinkGeometry> links;
  for (int k = 0; k < count; ++k) {
    centres.emplace_back(2 * radius * k, 0, 0);
    if (k > 0) links.push_back({k - 1, k, 2 * radius});
  }
  return assemble(centres, std::vector<double>(centres.size(), radius), links, law, 0.01 * count);
}

/// A loose random heap of spheres of unequal size that hardly overlap, linked where they are nearer than
/// `reach` times the sum of their radii.
inline dem::Assembly cluster(int count, const dem::LinkLaw& law, std::uint64_t seed, double reach = 1.4) {
  dem::Random random(seed);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  const double side = 0.02 * std::cbrt(static_cast<double>(count)) * 1.25;
  while (static_cast<int>(centres.size()) < count) {
    const double x = random.uniform(0, side), y = random.uniform(0, side), z = random.uniform(0, side);
    const double radius = random.uniform(0.006, 0.012);
    const Vec3 centre(x, y, z);
    bool clear = true;
    for (std::size_t k = 0; k < centres.size() && clear; ++k)
      clear = (centres[k] - centre).norm() > 0.95 * (radii[k] + radius);
    if (clear) centres.push_back(centre), radii.push_back(radius);
  }
  std::vector<dem::LinkGeometry> links;
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (std::size_t j = i + 1; j < centres.size(); ++j) {
      const double distance = (centres[i] - centres[j]).norm();
      if (distance < reach * (radii[i] + radii[j]))
        links.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), distance});
    }
  return assemble(centres, radii, links, law, 0.01 * count);
}

/// The links of an assembly that is still at rest, as they were given.
inline std::vector<dem::LinkGeometry> geometry_of(const dem::Links& links) {
  std::vector<dem::LinkGeometry> geometry;
  for (std::size_t k = 0; k < links.count; ++k)
    geometry.push_back({links.a[k], links.b[k], 1 / links.inverse_initial_distance[k]});
  return geometry;
}

inline dem::LinkNetwork network_of(const dem::Assembly& assembly) {
  return {assembly.particles.initial_position, assembly.particles.radius, geometry_of(assembly.links),
          assembly.law};
}

inline double critical_step_of(const dem::Assembly& assembly) {
  return dem::critical_time_step(network_of(assembly), assembly.particles);
}

/// Random velocities of up to `speed` in each direction, and spins to match.
inline void shake(dem::Particles& particles, double speed, std::uint64_t seed) {
  dem::Random random(seed);
  const auto any = [&](double most) {
    const double x = random.uniform(-most, most), y = random.uniform(-most, most),
                 z = random.uniform(-most, most);
    return Vec3(x, y, z);
  };
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Vec3 velocity = any(speed), spin = any(speed / particles.radius[i]);
    particles.set_velocity(i, velocity, spin);
  }
}

}  // namespace scene
