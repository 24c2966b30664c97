// What an engineer reads after an impact: fragments, crater and scab, passage, contact force.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "impact/outcome/force_record.h"
#include "impact/outcome/fragments.h"
#include "impact/outcome/slab_damage.h"
#include "libdem/core/error.h"
#include "libdem/core/random.h"
#include "tests/message_of.h"

using impact::Vec3;
using test::message_of;
using testing::HasSubstr;

namespace {

/// Elements and links that own their columns.
struct Pack {
  std::vector<Vec3> position, velocity;
  std::vector<double> radius, mass;
  std::vector<std::int32_t> a, b;
  std::vector<std::uint8_t> broken;

  void element(const Vec3& x, double r, double m, const Vec3& v = Vec3::Zero()) {
    position.push_back(x), radius.push_back(r), mass.push_back(m), velocity.push_back(v);
  }
  void link(int one, int other, bool is_broken = false) {
    a.push_back(one), b.push_back(other), broken.push_back(is_broken);
  }
  impact::Fragments fragments() const {
    return impact::find_fragments({position, velocity, radius, mass}, {a, b, broken});
  }
};

/// A slab of touching spheres on a cubic lattice, its front face at z = 0, linked to neighbours.
Pack lattice(int nx, int ny, int nz, double spacing) {
  Pack pack;
  const auto number = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        pack.element({(i + 0.5) * spacing, (j + 0.5) * spacing, -(k + 0.5) * spacing}, spacing / 2, 1);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (i + 1 < nx) pack.link(number(i, j, k), number(i + 1, j, k));
        if (j + 1 < ny) pack.link(number(i, j, k), number(i, j + 1, k));
        if (k + 1 < nz) pack.link(number(i, j, k), number(i, j, k + 1));
      }
  return pack;
}

}  // namespace

TEST(Fragments, AreWhatUnbrokenLinksHold) {
  Pack pack;
  pack.element({0, 0, 0}, 0.1, 1, {1, 0, 0});
  pack.element({1, 0, 0}, 0.1, 3, {0, 2, 0});
  pack.element({5, 0, 0}, 0.2, 10);
  pack.element({5, 1, 0}, 0.2, 10);
  pack.element({9, 0, 0}, 0.3, 4, {0, 0, 7});
  pack.link(0, 1), pack.link(1, 2, true), pack.link(2, 3), pack.link(4, 3, true);
  const impact::Fragments found = pack.fragments();
  ASSERT_EQ(found.fragments.size(), 3u);
  // Elements 0 and 1 are together as heavy as element 4: the lower number goes first.
  EXPECT_THAT(found.of_element, testing::ElementsAre(1, 1, 0, 0, 2));
  EXPECT_FALSE(found.detached(3));
  EXPECT_TRUE(found.detached(4));
  EXPECT_EQ(found.fragments[1].first, 0);
  EXPECT_EQ(found.fragments[2].first, 4);
}

TEST(Fragments, HaveMassCentreVelocityAndExtent) {
  Pack pack;
  pack.element({0, 0, 0}, 0.1, 1, {1, 0, 0});
  pack.element({1, 0, 0}, 0.2, 3, {0, 2, 0});
  pack.element({5, 0, 0}, 0.2, 10);
  pack.link(0, 1);
  const impact::Fragments found = pack.fragments();
  const impact::Fragment& small = found.fragments[1];
  EXPECT_EQ(small.elements, 2u);
  EXPECT_DOUBLE_EQ(small.mass, 4);
  EXPECT_NEAR(small.solid_volume, 4.0 / 3 * std::numbers::pi * (0.001 + 0.008), 1e-15);
  EXPECT_LT((small.centre - Vec3(0.75, 0, 0)).norm(), 1e-15);
  EXPECT_LT((small.velocity - Vec3(0.25, 1.5, 0)).norm(), 1e-15);
  EXPECT_LT((small.momentum() - Vec3(1, 6, 0)).norm(), 1e-15);
  EXPECT_LT((small.extent - Vec3(1.3, 0.4, 0.4)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(small.kinetic_energy, 0.5 + 6);
  const impact::DetachedSum sum = impact::sum_detached(found);
  EXPECT_EQ(sum.fragments, 1u);
  EXPECT_EQ(sum.single_elements, 0u);
  EXPECT_DOUBLE_EQ(sum.mass, 4);
  EXPECT_DOUBLE_EQ(sum.highest_speed, Vec3(0.25, 1.5, 0).norm());
}

TEST(Fragments, AgreeWithAFloodAndDoNotDependOnTheOrderOfLinks) {
  dem::Random random(3);
  Pack pack;
  const int count = 2000;
  for (int i = 0; i < count; ++i)
    pack.element({random.uniform(), random.uniform(), random.uniform()}, 0.01, 1 + random.uniform(),
                 {random.normal(), random.normal(), random.normal()});
  for (int k = 0; k < 2200; ++k)
    pack.link(static_cast<int>(random.below(count)), static_cast<int>(random.below(count)),
              random.uniform() < 0.5);
  const impact::Fragments found = pack.fragments();

  // Flood from every element over a table of neighbours.
  std::vector<std::vector<int>> neighbours(count);
  for (std::size_t k = 0; k < pack.a.size(); ++k)
    if (!pack.broken[k]) {
      neighbours[static_cast<std::size_t>(pack.a[k])].push_back(pack.b[k]);
      neighbours[static_cast<std::size_t>(pack.b[k])].push_back(pack.a[k]);
    }
  std::vector<int> seen(count, -1);
  int sets = 0;
  for (int start = 0; start < count; ++start) {
    if (seen[static_cast<std::size_t>(start)] >= 0) continue;
    std::vector<int> wet = {start};
    seen[static_cast<std::size_t>(start)] = sets;
    std::size_t size = 0;
    while (!wet.empty()) {
      const int i = wet.back();
      wet.pop_back(), ++size;
      EXPECT_EQ(found.of_element[static_cast<std::size_t>(i)],
                found.of_element[static_cast<std::size_t>(start)]);
      for (const int j : neighbours[static_cast<std::size_t>(i)])
        if (seen[static_cast<std::size_t>(j)] < 0) seen[static_cast<std::size_t>(j)] = sets, wet.push_back(j);
    }
    EXPECT_EQ(
        found.fragments[static_cast<std::size_t>(found.of_element[static_cast<std::size_t>(start)])].elements,
        size);
    ++sets;
  }
  EXPECT_EQ(found.fragments.size(), static_cast<std::size_t>(sets));
  EXPECT_TRUE(std::is_sorted(found.fragments.begin(), found.fragments.end(),
                             [](const auto& one, const auto& other) { return one.mass > other.mass; }));

  Pack turned = pack;
  std::reverse(turned.a.begin(), turned.a.end()), std::reverse(turned.b.begin(), turned.b.end());
  std::reverse(turned.broken.begin(), turned.broken.end());
  const impact::Fragments again = turned.fragments();
  EXPECT_EQ(again.of_element, found.of_element);
  for (std::size_t k = 0; k < found.fragments.size(); ++k)
    EXPECT_EQ(again.fragments[k].velocity, found.fragments[k].velocity);

  Vec3 momentum = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t i = 0; i < pack.mass.size(); ++i) momentum += pack.mass[i] * pack.velocity[i];
  for (const impact::Fragment& fragment : found.fragments) sum += fragment.momentum();
  EXPECT_LT((sum - momentum).norm(), 1e-10);
}

TEST(Fragments, RefuseTablesThatDoNotFit) {
  Pack pack;
  pack.element({0, 0, 0}, 0.1, 1);
  pack.link(0, 1);
  EXPECT_THAT(message_of([&] { pack.fragments(); }), HasSubstr("link 0 joins elements 0 and 1 of 1"));
  pack.a.clear(), pack.b.clear();
  EXPECT_THAT(message_of([&] { pack.fragments(); }), HasSubstr("links have 0, 0 and 1 rows"));
  pack.broken.clear(), pack.mass[0] = 0;
  EXPECT_THAT(message_of([&] { pack.fragments(); }), HasSubstr("element 0 has mass 0 kg"));
  pack.mass.clear();
  EXPECT_THAT(message_of([&] { pack.fragments(); }), HasSubstr("1 positions, 1 velocities, 1 radii, 0 masses"));
  EXPECT_TRUE(Pack().fragments().fragments.empty());
}

TEST(SlabDamage, FindsACraterAndAScabOfKnownSize) {
  // A half ball cut out in front, a disc behind: volumes as of the bodies, to what the lattice resolves.
  const double spacing = 0.01, solid = std::numbers::pi / 6;
  Pack pack = lattice(60, 60, 20, spacing);
  const Vec3 middle(0.3, 0.3, 0);
  const auto cut = [&](int i) {
    const Vec3 from = pack.position[static_cast<std::size_t>(i)] - middle;
    if (from.norm() < 0.08) return 1;
    return from.z() < -0.18 && std::hypot(from.x(), from.y()) < 0.15 ? 2 : 0;
  };
  for (std::size_t k = 0; k < pack.a.size(); ++k) pack.broken[k] = cut(pack.a[k]) != cut(pack.b[k]);
  const impact::Slab slab{{0, 0, 0}, Vec3::UnitZ(), 0.2};
  const impact::Fragments fragments = pack.fragments();
  EXPECT_EQ(fragments.fragments.size(), 3u);
  const impact::SlabLoss loss =
      impact::find_losses(slab, fragments, pack.position, pack.radius, pack.mass, solid);
  EXPECT_NEAR(loss.crater.volume / (2.0 / 3 * std::numbers::pi * std::pow(0.08, 3)), 1, 0.03);
  EXPECT_NEAR(loss.scab.volume / (std::numbers::pi * 0.15 * 0.15 * 0.02), 1, 0.03);
  EXPECT_NEAR(loss.crater.depth, 0.08, 0.5 * spacing);
  EXPECT_NEAR(loss.scab.depth, 0.02, 1e-12);
  EXPECT_NEAR(loss.scab.equivalent_radius, 0.15, 0.002);
  // A half ball's radius of gyration about its axis is sqrt(2/5) R.
  EXPECT_NEAR(loss.crater.equivalent_radius, 0.08 * std::sqrt(0.8), 0.002);
  EXPECT_EQ(loss.crater.elements + loss.scab.elements, impact::sum_detached(fragments).elements);
  EXPECT_DOUBLE_EQ(loss.crater.mass, static_cast<double>(loss.crater.elements));
}

TEST(SlabDamage, RefusesWhatCannotBe) {
  const Pack pack = lattice(2, 2, 2, 0.1);
  const impact::Fragments fragments = pack.fragments();
  impact::Slab slab{{0, 0, 0}, Vec3::UnitZ(), 0.2};
  const auto refusal = [&](double solid) {
    return message_of(
        [&] { impact::find_losses(slab, fragments, pack.position, pack.radius, pack.mass, solid); });
  };
  EXPECT_EQ(refusal(0.5), "no error");
  EXPECT_THAT(refusal(0), HasSubstr("the solid fraction is 0; it must be above 0"));
  slab.thickness = -1;
  EXPECT_THAT(refusal(0.5), HasSubstr("the slab's thickness is -1 m"));
  slab.outward *= 2;
  EXPECT_THAT(refusal(0.5), HasSubstr("the slab's normal has length 2"));
  slab = {{0, 0, 0}, Vec3::UnitZ(), 0.2};
  EXPECT_THAT(message_of([&] {
                impact::find_losses(slab, fragments, pack.position, pack.radius, std::vector<double>(3), 0.5);
              }),
              HasSubstr("8 elements, 8 positions, 8 radii, 3 masses"));
}

TEST(SlabDamage, JudgesWhereTheImpactorIs) {
  const impact::Slab slab{{0, 0, 1}, Vec3::UnitZ(), 0.3};
  const auto at = [&](double z, double vz) { return impact::judge(slab, {5, 5, z}, {1, 0, vz}, 0.15, 0.15); };
  EXPECT_EQ(at(1.2, -40).passage, impact::Passage::approaching);
  EXPECT_EQ(at(1.2, 5).passage, impact::Passage::rebounded);
  EXPECT_DOUBLE_EQ(at(1.2, 5).residual_velocity, -5);
  EXPECT_EQ(at(1.1, 5).passage, impact::Passage::inside);
  EXPECT_NEAR(at(1.1, 5).nose_depth, 0.05, 1e-15);
  EXPECT_EQ(at(0.75, -10).passage, impact::Passage::inside);
  EXPECT_EQ(at(0.65, 1).passage, impact::Passage::inside);
  EXPECT_FALSE(at(0.65, 1).perforated);
  EXPECT_EQ(at(0.65, -1).passage, impact::Passage::perforated);
  EXPECT_TRUE(at(0.65, -1).perforated);
  EXPECT_FALSE(at(0.65, -1).clear);
  EXPECT_TRUE(at(0.5, -1).clear);
  EXPECT_EQ(impact::name_of(impact::Passage::inside), "inside");
}

TEST(ForceRecord, ReducesAHalfSine) {
  // A linear spring's pulse: impulse 2 F T / pi, mean over a window w about the top F sin(pi w / 2T) 2T / (pi
  // w).
  const double peak = 3e6, duration = 1e-3, dt = 1e-6, window = 2e-4;
  impact::ForceRecord record(window);
  std::vector<double> time;
  std::vector<Vec3> force;
  for (int n = 0; n < 3000; ++n) {
    const double t = n * dt, in = (t - 5e-4) / duration;
    const Vec3 f =
        in > 0 && in < 1 ? Vec3(0, 0.6, 0.8) * (peak * std::sin(std::numbers::pi * in)) : Vec3(0, 0, 0);
    record.add(t, dt, f);
    time.push_back(t), force.push_back(f);
  }
  EXPECT_NEAR(record.peak_force() / peak, 1, 1e-5);
  EXPECT_NEAR(record.time_of_peak(), 1e-3, 1.1e-6);
  EXPECT_LT((record.impulse() - 2 / std::numbers::pi * peak * duration * Vec3(0, 0.6, 0.8)).norm(),
            1e-5 * peak * duration);
  const double half = std::numbers::pi * window / duration / 2;
  EXPECT_NEAR(record.peak_mean_force() / (peak * std::sin(half) / half), 1, 1e-5);
  EXPECT_NEAR(record.last_contact() - record.first_contact(), duration, 2.1 * dt);

  const impact::ForceRecord again = impact::reduce(time, force, window);
  EXPECT_NEAR(again.impulse().norm() / record.impulse().norm(), 1, 1e-12);
  EXPECT_NEAR(again.peak_mean_force() / record.peak_mean_force(), 1, 1e-12);
}

TEST(ForceRecord, GoesOnFromItsNumbers) {
  dem::Random random(9);
  impact::ForceRecord through(1e-5);
  const auto feed = [&](impact::ForceRecord& record, int n) {
    dem::Random own(static_cast<std::uint64_t>(n));
    record.add(n * 1e-6, 1e-6, {own.normal(), own.normal(), own.normal()});
  };
  for (int n = 0; n < 50; ++n) feed(through, n);
  impact::ForceRecord resumed = impact::ForceRecord::from_numbers(through.to_numbers(), "test");
  for (int n = 50; n < 100; ++n) feed(through, n), feed(resumed, n);
  EXPECT_EQ(resumed.to_numbers(), through.to_numbers());
  EXPECT_THAT(message_of([] { impact::ForceRecord::from_numbers(std::vector<double>(11), "checkpoint.h5"); }),
              HasSubstr("checkpoint.h5: a record of the contact force has 11 numbers"));
}

TEST(ForceRecord, WithoutContactSaysSo) {
  const impact::ForceRecord record;
  EXPECT_TRUE(std::isnan(record.first_contact()));
  EXPECT_TRUE(std::isnan(record.time_of_peak()));
  EXPECT_EQ(record.impulse().norm(), 0);
  EXPECT_THAT(message_of([] { impact::ForceRecord{-1}; }), HasSubstr("the window is -1 s"));
  const std::vector<double> time = {0, 1, 1};
  EXPECT_THAT(message_of([&] { impact::reduce(time, std::vector<Vec3>(3, Vec3::Zero())); }),
              HasSubstr("time 1 s follows 1 s"));
  EXPECT_THAT(message_of([&] { impact::reduce(time, std::vector<Vec3>(2, Vec3::Zero())); }),
              HasSubstr("3 times and 2 forces"));
}
