// Assemblies that are alike go alike ways: numbered otherwise, mirrored, of another size, weight or stiffness,
// or with links that hold nothing.
#include <numeric>

#include "tests/verification/property_scene.h"

using dem::Vec3;
using property::assemblies;
using property::Parts;
using property::Seen;
using scene::Scene;

namespace {

class Assemblies : public testing::TestWithParam<property::Kind> {};
INSTANTIATE_TEST_SUITE_P(Alike, Assemblies, property::all_kinds, property::name_of);

template <class Item>
void shuffle(std::vector<Item>& items, dem::Random& random) {
  for (std::size_t k = items.size(); k-- > 1;) std::swap(items[k], items[random.below(k + 1)]);
}

Vec3 mirrored(const Vec3& x) { return {-x.x(), x.y(), x.z()}; }
/// A spin has its sense from the right hand, which the mirror makes a left one.
Vec3 mirrored_spin(const Vec3& w) { return {w.x(), -w.y(), -w.z()}; }

/// Runs both and expects the same bits, lengths of the second times `length` and forces times `force`.
void expect_exactly(Scene& first, Scene& second, double length, double force, Seen& seen) {
  first.steps(property::steps), second.steps(property::steps);
  seen.add(first);
  for (std::size_t i = 0; i < first.particles().count; ++i) {
    const Vec3 place = length * first.position(i), pull = force * first.force(i);
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(second.position(i)[c], place[c]) << "element " << i;
      ASSERT_EQ(second.force(i)[c], pull[c]) << "element " << i;
    }
  }
}

/// Runs each assembly as it is, and as `change` leaves it.
template <class Change>
void expect_scaled(const property::Kind& kind, double length, double force, Change&& change) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, kind);
    Scene first = parts.scene();
    change(parts);
    Scene second = parts.scene();
    expect_exactly(first, second, length, force, seen);
    if (testing::Test::HasFatalFailure()) return;
  }
  seen.expect_of(kind);
}

}  // namespace

TEST_P(Assemblies, GoTheSameWayNumberedOtherwise) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Parts parts = property::any_parts(seed, GetParam());
    dem::Random random(3000 + seed);
    std::vector<std::int32_t> place(parts.centres.size());  // element i becomes place[i]
    std::iota(place.begin(), place.end(), 0);
    shuffle(place, random);
    Parts shuffled = parts;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const auto to = static_cast<std::size_t>(place[i]);
      shuffled.centres[to] = parts.centres[i], shuffled.radii[to] = parts.radii[i];
      shuffled.velocities[to] = parts.velocities[i], shuffled.spins[to] = parts.spins[i];
    }
    for (dem::LinkGeometry& link : shuffled.links) {
      link.a = place[static_cast<std::size_t>(link.a)], link.b = place[static_cast<std::size_t>(link.b)];
      if (random.below(2) == 0) std::swap(link.a, link.b);
    }
    shuffle(shuffled.links, random);
    Scene first = parts.scene(), second = shuffled.scene();
    property::expect_same_way(first, second, 1e-7, seen, [&](std::size_t i, const Vec3& x, double) {
      return std::pair(static_cast<std::size_t>(place[i]), x);
    });
    if (HasFatalFailure()) return;
  }
  seen.expect_of(GetParam());
}

TEST_P(Assemblies, GoTheMirroredWayInAMirror) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, GetParam());
    Scene first = parts.scene();
    for (auto* vectors : {&parts.centres, &parts.velocities})
      for (Vec3& v : *vectors) v = mirrored(v);
    for (Vec3& w : parts.spins) w = mirrored_spin(w);
    Scene second = parts.scene();
    property::expect_same_way(first, second, 1e-7, seen,
                              [&](std::size_t i, const Vec3& x, double) { return std::pair(i, mirrored(x)); });
    if (HasFatalFailure()) return;
  }
  seen.expect_of(GetParam());
}

// Two halves, each the other's image, linked across the mirror: what begins symmetric stays so.
TEST_P(Assemblies, ThatAreSymmetricStaySo) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, GetParam());
    const std::size_t half = parts.centres.size();
    double nearest = 1;
    for (std::size_t i = 0; i < half; ++i) nearest = std::min(nearest, parts.centres[i].x() - parts.radii[i]);
    for (Vec3& x : parts.centres) x.x() -= nearest;
    for (std::size_t i = 0; i < half; ++i) {
      parts.centres.push_back(mirrored(parts.centres[i])), parts.radii.push_back(parts.radii[i]);
      parts.velocities.push_back(mirrored(parts.velocities[i]));
      parts.spins.push_back(mirrored_spin(parts.spins[i]));
    }
    const std::size_t links = parts.links.size();
    const auto number = [&](std::size_t i) { return static_cast<std::int32_t>(i); };
    for (std::size_t k = 0; k < links; ++k)
      parts.links.push_back(
          {parts.links[k].a + number(half), parts.links[k].b + number(half), parts.links[k].initial_distance});
    for (std::size_t i = 0; i < half; ++i)
      for (std::size_t j = half; j < 2 * half; ++j) {
        const double distance = (parts.centres[i] - parts.centres[j]).norm();
        if (distance < 1.4 * (parts.radii[i] + parts.radii[j]))
          parts.links.push_back({number(i), number(j), distance});
      }
    parts.mass *= 2;
    Scene scene = parts.scene();
    scene.steps(property::steps);
    seen.add(scene);
    for (std::size_t i = 0; i < half; ++i)
      ASSERT_LT((scene.position(i + half) - mirrored(scene.position(i))).norm(),
                1e-7 * property::farthest(scene))
          << "element " << i;
  }
  seen.expect_of(GetParam());
}

// E, T and Co times k: stresses times k at the same strains. The mass goes along, so that the times stay.
TEST_P(Assemblies, OfTwiceTheStiffnessAndStrengthFeelTwiceTheForces) {
  expect_scaled(GetParam(), 1, 2, [](Parts& parts) {
    for (double* stress : {&parts.law.normal_modulus, &parts.law.tensile_strength, &parts.law.cohesion})
      *stress *= 2;
    parts.mass *= 2;
  });
}

// Lengths and times times k at the same speeds: the same strains and stresses, so forces times k squared.
TEST_P(Assemblies, OfTwiceTheSizeFeelTheSameStresses) {
  expect_scaled(GetParam(), 2, 4, [](Parts& parts) {
    for (Vec3& x : parts.centres) x *= 2;
    for (double& r : parts.radii) r *= 2;
    for (Vec3& w : parts.spins) w /= 2;
    for (dem::LinkGeometry& link : parts.links) link.initial_distance *= 2;
    parts.mass *= 8, parts.time_step *= 2;
  });
}

// The density times k: everything takes sqrt(k) times as long.
TEST_P(Assemblies, OfFourTimesTheDensityTakeTwiceTheTime) {
  expect_scaled(GetParam(), 1, 1, [](Parts& parts) {
    for (auto* vectors : {&parts.velocities, &parts.spins})
      for (Vec3& v : *vectors) v /= 2;
    parts.mass *= 4, parts.time_step *= 2;
  });
}

// Links that break at nothing are contacts from the first step on: no link at all does the same.
TEST_P(Assemblies, WithLinksThatHoldNothingGoTheWayOfThoseWithout) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= assemblies; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Parts parts = property::any_parts(seed, GetParam());
    parts.law.tensile_strength = parts.law.cohesion = 1e-9;
    parts.law.broken_link_contact = dem::BrokenLinkContact::radii;
    // Those that are apart are linked as if they had touched: a stretch that breaks them in the first step,
    // before they can meet.
    std::erase_if(parts.links, [&](dem::LinkGeometry& link) {
      const double sum =
          parts.radii[static_cast<std::size_t>(link.a)] + parts.radii[static_cast<std::size_t>(link.b)];
      const bool near = link.initial_distance < 1.001 * sum;
      link.initial_distance = sum;
      return near;
    });
    // They fall towards each other, and meet.
    for (std::size_t i = 0; i < parts.centres.size(); ++i) parts.velocities[i] -= 300 * parts.centres[i];
    Scene linked = parts.scene();
    parts.links.clear();
    Scene alone = parts.scene();
    property::expect_same_way(linked, alone, 1e-7, seen,
                              [](std::size_t i, const Vec3& x, double) { return std::pair(i, x); });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.broken, 100U);
}
