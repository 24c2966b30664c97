// Random small assemblies for what holds for all of them: sizes, places, links, law and motion are drawn from a
// seed, which a failure names.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "libdem/probe/damage.h"
#include "tests/verification/scene.h"

namespace property {

using dem::Vec3;
using scene::Scene;

/// What kind of assembly: its law, and whether it falls to pieces that meet again.
struct Kind {
  bool moments = false;  ///< the law that transfers moments, otherwise the paper's
  bool debris = false;   ///< fast, and not all neighbours are linked: links break, contacts push and slide
};

inline std::string name_of(const testing::TestParamInfo<Kind>& info) {
  return std::string(info.param.moments ? "WithMoments" : "Paper") + (info.param.debris ? "AndContacts" : "");
}

inline const auto all_kinds =
    testing::Values(Kind{false, false}, Kind{false, true}, Kind{true, false}, Kind{true, true});

constexpr std::uint64_t assemblies = 50;
constexpr int steps = 400;

/// All numbers and named choices of a law, within a factor of two of the usual ones.
inline dem::LinkLaw any_law(dem::Random& random, const Kind& kind) {
  dem::LinkLaw law = kind.moments ? scene::with_moments(scene::plain_law()) : scene::plain_law();
  for (double* value : {&law.normal_modulus, &law.shear_ratio, &law.tensile_strength, &law.cohesion,
                        &law.softening, &law.internal_slope, &law.contact_slope})
    *value *= random.uniform(0.7, 1.4);
  law.unloading = random.below(2) == 0 ? dem::SofteningUnloading::secant : dem::SofteningUnloading::elastic;
  law.cohesion_during_softening = random.below(2) == 0 ? dem::CohesionDuringSoftening::constant
                                                       : dem::CohesionDuringSoftening::proportional;
  law.broken_link_contact =
      random.below(2) == 0 ? dem::BrokenLinkContact::initial_distance : dem::BrokenLinkContact::radii;
  return law;
}

/// What an assembly is made of, to be made once as it is and once with something changed.
struct Parts {
  std::vector<Vec3> centres, velocities, spins;
  std::vector<double> radii;
  std::vector<dem::LinkGeometry> links;
  dem::LinkLaw law;
  double mass = 0, time_step = 0;

  Scene scene() const {
    dem::Assembly made = scene::assemble(centres, radii, links, law, mass);
    for (std::size_t i = 0; i < centres.size(); ++i) made.particles.set_velocity(i, velocities[i], spins[i]);
    return {std::move(made), time_step};
  }
};

inline Vec3 any_vector(dem::Random& random, double most) {
  const double x = random.uniform(-most, most), y = random.uniform(-most, most),
               z = random.uniform(-most, most);
  return {x, y, z};
}

inline Parts any_parts(std::uint64_t seed, const Kind& kind) {
  dem::Random random(seed);
  Parts parts;
  parts.law = any_law(random, kind);
  const std::size_t count = 8 + random.below(13);
  // Each one nearly touches one that is there, and overlaps none: what nothing links pushes soon, not at once.
  while (parts.centres.size() < count) {
    const double radius = random.uniform(0.006, 0.012);
    Vec3 centre = Vec3::Zero();
    if (!parts.centres.empty()) {
      const std::size_t beside = random.below(parts.centres.size());
      const double gap = random.uniform(1e-5, 1e-4);
      centre = parts.centres[beside] +
               (1 + gap) * (parts.radii[beside] + radius) * any_vector(random, 1).normalized();
    }
    bool clear = true;
    for (std::size_t k = 0; k < parts.centres.size() && clear; ++k)
      clear = (parts.centres[k] - centre).norm() > parts.radii[k] + radius;
    if (clear) parts.centres.push_back(centre), parts.radii.push_back(radius);
  }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const double distance = (parts.centres[i] - parts.centres[j]).norm(),
                   sum = parts.radii[i] + parts.radii[j];
      const bool linked = distance < 1.4 * sum && (!kind.debris || random.below(3) > 0);
      if (linked) parts.links.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), distance});
    }
  const double speed = kind.debris ? random.uniform(1, 4) : random.uniform(0.2, 0.8);
  for (std::size_t i = 0; i < count; ++i) {
    parts.velocities.push_back(any_vector(random, speed));
    parts.spins.push_back(any_vector(random, speed / parts.radii[i]));
  }
  parts.mass = 0.01 * static_cast<double>(count);
  // A third of the critical step of the lightest element between a dozen of the stiffest links.
  double stiffest = 0;
  for (const double r : parts.radii) stiffest = std::max(stiffest, parts.law.normal_modulus * 3 * r);
  const double lightest = parts.mass / static_cast<double>(count) / 8;
  parts.time_step = 0.2 * std::sqrt(lightest / stiffest);
  return parts;
}

/// How far the elements went, the farthest of them [m].
inline double farthest(const Scene& scene) {
  double most = 0;
  for (std::size_t i = 0; i < scene.assembly.particles.count; ++i)
    most = std::max(most, scene.assembly.particles.displacement(i).norm());
  return most;
}

/// What the assemblies of a test went through, all together: a property of nothing proves nothing.
struct Seen {
  std::size_t yielded = 0, broken = 0, contacts = 0;

  void add(const Scene& scene) {
    const dem::Links& links = scene.assembly.links;
    for (std::size_t k = 0; k < links.count; ++k) yielded += links.max_strain[k] > 0;
    broken += dem::broken_links(scene.assembly.law, links);
    contacts += scene.assembly.contacts.count;
  }
  void expect_of(const Kind& kind) const {
    EXPECT_GT(yielded, 100U);
    if (kind.debris) {
      EXPECT_GT(broken, 100U);
      EXPECT_GT(contacts, 100U);
    }
  }
};

/// Runs `first` and `second` side by side, and expects that an element of the one stands where `where(i, x, t)`
/// puts that of the other. `close` is the allowed distance over the farthest way.
template <class Where>
void expect_same_way(Scene& first, Scene& second, double close, Seen& seen, Where&& where) {
  first.steps(steps), second.steps(steps);
  seen.add(first);
  const double time = steps * first.options.time_step, way = farthest(first);
  ASSERT_GT(way, 0);
  for (std::size_t i = 0; i < first.assembly.particles.count; ++i) {
    const auto& [j, place] = where(i, first.position(i), time);
    ASSERT_LT((second.position(j) - place).norm(), close * way) << "element " << i;
  }
}

}  // namespace property
