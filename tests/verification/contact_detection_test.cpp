// The contact detector against trying every pair, at every step of fast debris.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tests/verification/scene.h"

using dem::Vec3;
using scene::Scene;

namespace {

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

Pairs pairs_of(const dem::Links& links) {
  Pairs pairs;
  for (std::size_t k = 0; k < links.count; ++k)
    pairs.emplace(std::min(links.a[k], links.b[k]), std::max(links.a[k], links.b[k]));
  return pairs;
}

Pairs overlapping(const dem::Particles& particles) {
  Pairs pairs;
  for (std::size_t i = 0; i < particles.count; ++i)
    for (std::size_t j = i + 1; j < particles.count; ++j)
      if ((particles.kinematics[i].position() - particles.kinematics[j].position()).norm() <
          particles.radius[i] + particles.radius[j])
        pairs.emplace(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
  return pairs;
}

/// Two clusters that fly at each other and shatter; velocities of up to 100 m/s.
dem::Assembly collision(std::uint64_t seed) {
  dem::LinkLaw law = scene::plain_law();
  law.normal_modulus = 1e9;  // soft, so that steps are long and paths per step too
  const dem::Assembly one = scene::cluster(70, law, seed), two = scene::cluster(70, law, seed + 1);
  std::vector<Vec3> centres = one.particles.initial_position;
  std::vector<double> radii = one.particles.radius;
  std::vector<dem::LinkGeometry> links = scene::geometry_of(one.links);
  const auto shift = static_cast<std::int32_t>(centres.size());
  for (std::size_t i = 0; i < two.particles.count; ++i) {
    centres.push_back(two.particles.initial_position[i] + Vec3(0.16, 0.01, 0.02));
    radii.push_back(two.particles.radius[i]);
  }
  for (dem::LinkGeometry link : scene::geometry_of(two.links))
    links.push_back({link.a + shift, link.b + shift, link.initial_distance});
  dem::Assembly both = scene::assemble(centres, radii, links, law, 1.4);
  scene::shake(both.particles, 5, seed + 2);
  for (std::size_t i = 0; i < both.particles.count; ++i) {
    const Vec3 v = both.particles.kinematics[i].velocity();
    both.particles.set_velocity(i, v + Vec3(i < one.particles.count ? 50 : -50, 0, 0));
  }
  return both;
}

/// Elements that fly straight on: most hardly move, a few are fast and one leaves for good.
dem::Particles debris(std::uint64_t seed) {
  dem::Assembly heap = scene::cluster(300, scene::plain_law(), seed);
  scene::shake(heap.particles, 0.5, seed);
  for (std::size_t i = 0; i < 30; ++i) {
    const Vec3 v = heap.particles.kinematics[10 * i].velocity();
    heap.particles.set_velocity(10 * i, (i == 0 ? 4000 : 200) * v);
  }
  return heap.particles;
}

double fastest_of(const dem::Particles& particles) {
  double square = 0;
  for (std::size_t i = 0; i < particles.count; ++i)
    square = std::max(square, particles.kinematics[i].velocity().squaredNorm());
  return std::sqrt(square);
}

void fly(dem::Particles& particles, double time_step) {
  for (std::size_t i = 0; i < particles.count; ++i) {
    dem::Kinematics& k = particles.kinematics[i];
    k.x += time_step * k.vx, k.y += time_step * k.vy, k.z += time_step * k.vz;
  }
}

bool same_lists(const dem::Links& p, const dem::Links& q) {
  return p.count == q.count && p.a == q.a && p.b == q.b && p.shear_x == q.shear_x;
}

}  // namespace

TEST(ContactDetector, ListsBeforeAStepEveryPairThatOverlapsAfterIt) {
  // From a skin that one step outruns to one that hardly any element leaves.
  constexpr double dt = 2e-6;
  for (const double skin : {1e-7, 1e-5, 3e-4, 0.0, 0.01}) {
    dem::Particles particles = debris(60);
    dem::ContactDetector detector(particles, dem::Links{}, skin);
    dem::Links contacts;
    std::size_t met = 0;
    for (int n = 0; n < 300; ++n) {
      detector.update(particles, contacts, fastest_of(particles), dt);
      fly(particles, dt);
      const Pairs listed = pairs_of(contacts);
      for (const auto& pair : overlapping(particles)) {
        ++met;
        ASSERT_TRUE(listed.contains(pair))
            << pair.first << ", " << pair.second << ", step " << n << ", skin " << skin;
      }
    }
    EXPECT_GT(met, 1000u);
  }
}

TEST(ContactDetector, KeepsOneListOnAnyNumberOfThreadsAndAcrossAStop) {
  constexpr double dt = 2e-6;
  dem::Particles particles = debris(70);
  dem::ContactDetector one(particles, dem::Links{}), many = one, stopped = one;
  dem::Links of_one, of_many, of_stopped;
  int changes = 0;
  for (int n = 0; n < 400; ++n) {
    if (n % 37 == 0) {  // begins anew with what a checkpoint keeps: the list and the memory
      const dem::ContactDetector::Memory memory = stopped.memory();
      stopped = dem::ContactDetector(particles, dem::Links{});
      stopped.restore(memory);
    }
    const double fastest = fastest_of(particles);
    changes += one.update(particles, of_one, fastest, dt) ? 1 : 0;
    many.update(particles, of_many, fastest, dt, 3);
    stopped.update(particles, of_stopped, fastest, dt);
    for (std::size_t k = 0; k < of_one.count; ++k)  // a history of its own for each pair
      of_one.shear_x[k] = of_many.shear_x[k] = of_stopped.shear_x[k] += of_one.a[k] + 1e-3 * of_one.b[k];
    ASSERT_TRUE(same_lists(of_one, of_many)) << "step " << n;
    ASSERT_TRUE(same_lists(of_one, of_stopped)) << "step " << n;
    fly(particles, dt);
  }
  EXPECT_GT(changes, 20);
}

TEST(ContactDetector, ListsAnewOnlyWhatMoves) {
  // One of 300 elements moves: the others' listed places stay as they were.
  dem::Particles particles = debris(80);
  for (std::size_t i = 0; i < particles.count; ++i) particles.set_velocity(i, Vec3::Zero());
  particles.set_velocity(7, Vec3(100, 0, 0));
  dem::ContactDetector detector(particles, dem::Links{});
  dem::Links contacts;
  detector.update(particles, contacts, 100, 1e-6);
  const std::vector<Vec3> before = detector.memory().built_at;
  for (int n = 0; n < 200; ++n) detector.update(particles, contacts, 100, 1e-6), fly(particles, 1e-6);
  const std::vector<Vec3> after = detector.memory().built_at;
  EXPECT_GT(detector.rebuilds(), 3);
  for (std::size_t i = 0; i < particles.count; ++i) EXPECT_EQ(before[i] == after[i], i != 7) << i;
}

TEST(ContactDetector, MissesNoOverlappingPairAtAnyStepOfFastDebris) {
  for (const double skin : {0.0, 1e-6, 3e-4, 0.02}) {
    const dem::Assembly start = collision(40);
    const Pairs linked = pairs_of(start.links);
    Scene scene(start, 0.2 * scene::critical_step_of(start));
    scene.room.detector = dem::ContactDetector(start.particles, start.links, skin);
    std::size_t met = 0, most = 0;
    constexpr int steps = 900;
    for (int n = 0; n < steps; ++n) {
      scene.step();
      const Pairs listed = pairs_of(scene.assembly.contacts);
      ASSERT_EQ(listed.size(), scene.assembly.contacts.count) << "a pair is listed twice";
      std::size_t now = 0;
      for (const auto& pair : overlapping(scene.particles())) {
        if (linked.contains(pair)) continue;
        ++now;
        ASSERT_TRUE(listed.contains(pair)) << pair.first << ", " << pair.second << ", step " << n;
      }
      for (const auto& pair : listed) ASSERT_FALSE(linked.contains(pair)) << "a link is no contact";
      met += now, most = std::max(most, now);
    }
    EXPECT_GT(most, 10u);
    EXPECT_GT(met, 1000u);
    if (skin == 0.02) {
      EXPECT_LT(scene.room.detector.rebuilds(), steps / 2);
    }
    if (skin == 1e-6) {
      EXPECT_GT(scene.room.detector.rebuilds(), steps * 9 / 10);
    }
  }
}

TEST(ContactDetector, RebuildsChangeNothingInTheMotion) {
  // Contacts keep their shear force when the list is made anew: runs that rebuild at each step and hardly ever
  // agree bit for bit.
  const dem::Assembly start = collision(50);
  const double dt = 0.2 * scene::critical_step_of(start);
  Scene often(start, dt), seldom(start, dt);
  often.room.detector = dem::ContactDetector(start.particles, start.links, 1e-7);
  seldom.room.detector = dem::ContactDetector(start.particles, start.links, 0.02);
  double shear = 0;
  for (int n = 0; n < 900; ++n) {
    often.step(), seldom.step();
    for (std::size_t k = 0; k < often.assembly.contacts.count; ++k)
      shear = std::max(shear, std::abs(often.assembly.contacts.shear_y[k]));
    for (std::size_t i = 0; i < start.particles.count; ++i)
      ASSERT_EQ((often.position(i) - seldom.position(i)).norm(), 0) << "step " << n << ", element " << i;
  }
  EXPECT_GT(shear, 1) << "contacts have rubbed";
  EXPECT_GT(often.room.detector.rebuilds(), 2 * seldom.room.detector.rebuilds());
}

TEST(ContactDetector, KeepsTheShearForceOfARestingContact) {
  scene::Pair pair(scene::plain_law(), false, 0.09 - 1e-5);
  pair.room.detector = dem::ContactDetector(pair.particles(), pair.assembly.links, 1e-7);
  pair.move(Vec3(0, 5e-7, 0), 50);  // five rebuilds or more on the way
  EXPECT_GE(pair.room.detector.rebuilds(), 5);
  const double stiffness =
      pair.assembly.law.shear_ratio * pair.assembly.law.normal_modulus * scene::Pair::area / 0.09;
  EXPECT_NEAR(pair.shear().y(), stiffness * 5e-7, 1e-2 * stiffness * 5e-7);
}
