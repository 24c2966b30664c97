// Specimens: homogeneous, isotropic, 12 links, the same for any number of threads, and refused when too small.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"
#include "libdem/search/cell_grid.h"
#include "specimens/extract.h"
#include "specimens/grading.h"
#include "specimens/inspect.h"
#include "specimens/interaction_range.h"
#include "specimens/isotropy.h"
#include "specimens/packing.h"
#include "specimens/representative.h"
#include "specimens/space_filling_curve.h"
#include "specimens/specimen_file.h"

using specimens::Grading;
using specimens::PackingOptions;
using specimens::Shape;
using specimens::Specimen;
using specimens::Vec3;
using testing::HasSubstr;

namespace {

PackingOptions box(const Vec3& size, std::size_t elements, std::uint64_t seed = 1) {
  PackingOptions options;
  options.size = size;
  options.elements = elements;
  options.seed = seed;
  options.threads = 1;
  return options;
}

PackingOptions cylinder(double diameter, double length, std::size_t elements) {
  PackingOptions options = box({diameter, diameter, length}, elements);
  options.shape = Shape::cylinder;
  return options;
}

// The paper's usual sample, made once.
const Specimen& sample() {
  static const Specimen made = make_specimen(box({0.5, 0.25, 0.25}, 2700));
  return made;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return "(accepted)";
}

class SpecimenFile : public testing::Test {
 protected:
  SpecimenFile() { std::filesystem::create_directories(folder); }
  ~SpecimenFile() override { std::filesystem::remove_all(folder); }
  std::filesystem::path file(const std::string& name) const { return folder / name; }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      (std::string("spall-specimen-test-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace

TEST(Packing, GivesInternalElementsTwelveLinks) {
  EXPECT_NEAR(mean_interior_coordination(sample()), 12, 0.02);
  EXPECT_GT(sample().interaction_radius_factor, 1.4);
  EXPECT_LT(sample().interaction_radius_factor, 1.65);
}

TEST(Packing, LinksExactlyWhatTheFactorSays) {
  const Specimen& made = sample();
  std::set<std::pair<int, int>> expected, linked;
  for (std::size_t a = 0; a < made.elements(); ++a)
    for (std::size_t b = a + 1; b < made.elements(); ++b)
      if ((made.centres[a] - made.centres[b]).norm() <=
          made.interaction_radius_factor * (made.radii[a] + made.radii[b]))
        expected.emplace(a, b);
  for (const specimens::Link& link : made.links) {
    linked.emplace(link.a, link.b);
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    EXPECT_DOUBLE_EQ(link.initial_distance, (made.centres[a] - made.centres[b]).norm());
  }
  EXPECT_EQ(linked, expected);
  EXPECT_EQ(linked.size(), made.links.size());
  EXPECT_TRUE(std::is_sorted(made.links.begin(), made.links.end(), [](const auto& p, const auto& q) {
    return std::pair(p.a, p.b) < std::pair(q.a, q.b);
  }));
}

TEST(Packing, LeavesNoOverlapAndStaysInside) {
  const Specimen& made = sample();
  double solid = 0;
  for (std::size_t k = 0; k < made.elements(); ++k) {
    EXPECT_GE(made.depth(made.centres[k]), made.radii[k] * (1 - 1e-9));
    solid += 4 * std::numbers::pi / 3 * std::pow(made.radii[k], 3);
  }
  EXPECT_NEAR(solid / made.volume(), 0.42, 1e-9);
  const double largest = *std::max_element(made.radii.begin(), made.radii.end());
  int overlapping = 0;
  dem::CellGrid(made.centres, 2 * largest).for_each_pair_within(2 * largest, [&](int i, int j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    overlapping += (made.centres[a] - made.centres[b]).norm() < made.radii[a] + made.radii[b];
  });
  EXPECT_EQ(overlapping, 0);
}

TEST(Packing, IsTheSameForAnyNumberOfThreads) {
  PackingOptions options = box({0.6, 0.6, 0.6}, 18672);  // enough elements for a second thread to get some
  const std::string one = make_specimen(options).sha256();
  options.threads = 2;
  EXPECT_EQ(make_specimen(options).sha256(), one);
  EXPECT_EQ(make_specimen(box({0.5, 0.25, 0.25}, 2700)).sha256(), sample().sha256());
  EXPECT_NE(make_specimen(box({0.5, 0.25, 0.25}, 2700, 2)).sha256(), sample().sha256());
}

TEST(Packing, IsEvenAndIsotropic) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const specimens::Inspection found = inspect(make_specimen(box({0.5, 0.25, 0.25}, 2700, seed)));
    EXPECT_TRUE(found.isotropic);
    EXPECT_LT(found.density_variation, 0.012);
    EXPECT_NEAR(found.fabric_eigenvalues[0] + found.fabric_eigenvalues[1] + found.fabric_eigenvalues[2], 1,
                1e-12);
    EXPECT_GT(found.fabric_eigenvalues[0], 0.31);
    EXPECT_LT(found.fabric_eigenvalues[2], 0.355);
    EXPECT_NEAR(found.fabric_fourth_moment, 0.6, 0.02);  // the lattice that it started from has left no trace
  }
}

TEST(Packing, MakesThePapersSamplesAndCylinders) {
  for (const PackingOptions& options :
       {box({0.25, 0.25, 0.25}, 1350), box({0.6, 0.6, 0.6}, 1427), cylinder(0.0986, 0.3, 2700),
        cylinder(0.0986, 0.3, 1500), box({0.28, 0.5, 0.4}, 4838)}) {
    const Specimen made = make_specimen(options);
    EXPECT_EQ(made.elements(), options.elements);
    EXPECT_NEAR(mean_interior_coordination(made), 12, 0.02);
  }
}

TEST(Packing, RefusesWhatIsNotRepresentative) {
  EXPECT_THAT(refusal([] {
                make_specimen(box({0.5, 0.25, 0.25}, 200));
              }),
              testing::AllOf(HasSubstr("200 elements"), HasSubstr("across the smallest side")));
  EXPECT_THAT(refusal([] { make_specimen(box({0.25, 0.25, 0.25}, 200)); }), HasSubstr("representative"));
  EXPECT_THAT(refusal([] {
                make_specimen(box({0.25, 0.25, 0.25}, 530));
              }),
              HasSubstr("deeper than two element sizes"));
}

TEST(Packing, RefusesImpossibleOptions) {
  const PackingOptions good = box({0.5, 0.25, 0.25}, 2700);
  const auto refused = [&](auto&& change) {
    PackingOptions options = good;
    change(options);
    return refusal([&] { options.validate(); });
  };
  EXPECT_THAT(refused([](PackingOptions& o) { o.size.x() = 0; }), HasSubstr("packing: size"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.size.x() = std::nan(""); }), HasSubstr("packing: size"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.shape = Shape::cylinder; }), HasSubstr("two diameters"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.elements = 0; }), HasSubstr("packing: elements"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.dense_solid_fraction = 0.8; }),
              HasSubstr("dense_solid_fraction"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.solid_fraction = 0.6; }), HasSubstr("packing: solid_fraction"));
  EXPECT_THAT(refused([](PackingOptions& o) { o.grading.size_ratio = 0.5; }), HasSubstr("size_ratio"));
  EXPECT_EQ(refused([](PackingOptions&) {}), "(accepted)");
}

TEST(Isotropy, SeesAPreferredDirection) {
  Specimen squeezed = sample();
  for (Vec3& centre : squeezed.centres) centre.x() *= 0.8;
  squeezed.size.x() *= 0.8;
  EXPECT_FALSE(isotropy_of(squeezed).isotropic);
  EXPECT_THAT(why_not_representative(squeezed), HasSubstr("not isotropic"));
  const auto histogram = specimens::orientation_histogram(sample(), 12);
  double sum = 0;
  for (const double value : histogram[1]) {
    EXPECT_NEAR(value, 1, 0.15);
    sum += value;
  }
  EXPECT_NEAR(sum, 12, 1e-9);
}

TEST(Grading, FollowsItsDistribution) {
  Grading grading;
  auto radii = grading.radii(1000);
  EXPECT_NEAR(radii.back() / radii.front(), 2, 2e-3);
  grading.kind = Grading::Kind::lognormal;
  radii = grading.radii(1001);
  EXPECT_NEAR(radii[500], 1, 1e-6);
  EXPECT_LT(radii.back(), std::exp(2 * grading.log_deviation));
  grading.kind = Grading::Kind::equal;
  EXPECT_EQ(grading.radii(3), std::vector<double>(3, 1.0));

  grading.kind = Grading::Kind::sieve;
  grading.sieves = {{4e-3, 0}, {8e-3, 0.4}, {16e-3, 1}};
  radii = grading.radii(20000);
  EXPECT_TRUE(std::is_sorted(radii.begin(), radii.end()));
  double total = 0, passing = 0;
  for (const double radius : radii) {
    total += radius * radius * radius;
    if (radius < 4e-3) passing += radius * radius * radius;
  }
  EXPECT_NEAR(passing / total, 0.4, 1e-3);

  grading.sieves[1].passing = 2;
  EXPECT_THAT(refusal([&] { grading.validate(); }), HasSubstr("sieves"));
  grading.sieves = {{1e-3, 0}, {16e-3, 1}};
  EXPECT_THAT(refusal([&] { grading.validate(); }), HasSubstr("16 times the smallest"));
}

TEST(Grading, EachKindPacks) {
  for (const Grading::Kind kind : {Grading::Kind::equal, Grading::Kind::lognormal, Grading::Kind::sieve}) {
    PackingOptions options = box({0.25, 0.25, 0.25}, 1350);
    options.grading.kind = kind;
    options.grading.sieves = {{8e-3, 0}, {11e-3, 0.4}, {16e-3, 1}};
    options.dense_solid_fraction = 0.6;
    EXPECT_NEAR(mean_interior_coordination(make_specimen(options)), 12, 0.02);
  }
}

TEST(SpaceFillingCurve, StepsFromCellToNeighbouringCell) {
  std::vector<Vec3> points;
  for (int k = 0; k < 512; ++k) points.emplace_back(k % 8 + 0.5, k / 8 % 8 + 0.5, k / 64 + 0.5);
  const auto order = specimens::hilbert_order(points, Vec3::Zero(), 8);
  EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 512u);
  for (std::size_t k = 1; k < order.size(); ++k)
    EXPECT_DOUBLE_EQ(
        (points[static_cast<std::size_t>(order[k])] - points[static_cast<std::size_t>(order[k - 1])]).norm(),
        1);
}

TEST(Extract, CutsARepresentativeCubeOutOfASlab) {
  PackingOptions options = box({0.6, 0.5, 0.28}, 7258);
  const Specimen slab = make_specimen(options);
  const Vec3 centre(0.3, 0.25, 0.14), size(0.28, 0.28, 0.28);
  const Specimen cube = extract(slab, Shape::box, centre, size);
  EXPECT_NEAR(static_cast<double>(cube.elements()), 7258 * cube.volume() / slab.volume(), 60);
  EXPECT_NEAR(mean_interior_coordination(cube), 12, 0.02);
  EXPECT_NEAR(cube.interaction_radius_factor, slab.interaction_radius_factor, 0.02);
  EXPECT_THAT(cube.origin, HasSubstr("extracted"));
  // The elements are where they were, in their order.
  std::size_t in_slab = 0;
  for (std::size_t k = 0; k < cube.elements(); ++k) {
    const Vec3 there = cube.centres[k] + centre - size / 2;
    while (in_slab < slab.elements() && (slab.centres[in_slab] - there).norm() > 1e-12) ++in_slab;
    ASSERT_LT(in_slab, slab.elements());
    EXPECT_EQ(cube.radii[k], slab.radii[in_slab]);
  }
  const Specimen core = extract(slab, Shape::cylinder, centre, {0.26, 0.26, 0.28});
  EXPECT_EQ(core.shape, Shape::cylinder);
  EXPECT_NEAR(mean_interior_coordination(core), 12, 0.02);
}

TEST(Extract, RefusesRegionsThatStickOutOrHoldTooLittle) {
  const auto from = [&](Shape shape, const Vec3& centre, const Vec3& size) {
    return refusal([&] { extract(sample(), shape, centre, size); });
  };
  EXPECT_THAT(from(Shape::box, {0.4, 0.125, 0.125}, {0.25, 0.25, 0.25}), HasSubstr("sticks out by 0.025 m"));
  EXPECT_THAT(from(Shape::box, {0.25, 0.125, 0.125}, {0.1, 0.1, 0.1}), HasSubstr("representative"));
  EXPECT_THAT(from(Shape::box, {0.25, 0.125, 0.125}, {0.1, -0.1, 0.1}), HasSubstr("extract: size"));
  EXPECT_THAT(from(Shape::box, {std::nan(""), 0, 0}, {0.1, 0.1, 0.1}), HasSubstr("extract: centre"));
  EXPECT_THAT(from(Shape::box, {0.25, 0.125, 0.125}, {1e-6, 1e-6, 1e-6}), HasSubstr("no element"));
  EXPECT_EQ(from(Shape::box, {0.25, 0.125, 0.125}, {0.25, 0.25, 0.25}), "(accepted)");
}

TEST_F(SpecimenFile, ComesBackAsItWas) {
  write_specimen(file("s.h5"), sample());
  const Specimen back = specimens::read_specimen(file("s.h5"));
  EXPECT_EQ(back.sha256(), sample().sha256());
  EXPECT_EQ(back.seed, sample().seed);
  EXPECT_EQ(back.origin, sample().origin);
  EXPECT_EQ(back.interaction_radius_factor, sample().interaction_radius_factor);
}

TEST_F(SpecimenFile, RefusesTruncatedOtherAndDamagedFiles) {
  const auto reading = [&](const char* name) { return refusal([&] { specimens::read_specimen(file(name)); }); };
  EXPECT_THAT(reading("none.h5"), HasSubstr("no such file"));
  write_specimen(file("s.h5"), sample());
  std::filesystem::copy_file(file("s.h5"), file("cut.h5"));
  std::filesystem::resize_file(file("cut.h5"), std::filesystem::file_size(file("s.h5")) / 2);
  EXPECT_THAT(reading("cut.h5"), HasSubstr("truncated"));
  dem::create_spall_file(file("other.h5"), "spall-checkpoint", 1, [](dem::Hdf5File&) {});
  EXPECT_THAT(reading("other.h5"), HasSubstr("is a spall-checkpoint file, not a spall-specimen file"));
  dem::create_spall_file(file("empty.h5"), "spall-specimen", 1, [](dem::Hdf5File&) {});
  EXPECT_THAT(reading("empty.h5"), HasSubstr("missing"));

  const std::map<std::string, std::pair<std::function<void(Specimen&)>, std::string>> damages{
      {"nan.h5", {[](Specimen& s) { s.centres[7].y() = std::nan(""); }, "element 7 is outside"}},
      {"outside.h5", {[](Specimen& s) { s.centres[7].y() = 3; }, "element 7 is outside"}},
      {"radius.h5", {[](Specimen& s) { s.radii[3] = -1; }, "element 3 has radius -1"}},
      {"index.h5", {[](Specimen& s) { s.links.back().b = 2700; }, "joins elements"}},
      {"twice.h5", {[](Specimen& s) { s.links[5] = s.links[4]; }, "doubled or out of order"}},
      {"order.h5", {[](Specimen& s) { std::swap(s.links[5], s.links[900]); }, "doubled or out of order"}},
      {"distance.h5",
       {[](Specimen& s) { s.links[5].initial_distance = std::numeric_limits<double>::infinity(); },
        "initial distance"}},
      {"size.h5", {[](Specimen& s) { s.size.z() = -1; }, "size is not positive"}},
  };
  for (const auto& [name, damage] : damages) {
    Specimen damaged = sample();
    damage.first(damaged);
    write_specimen(file(name), damaged);
    EXPECT_THAT(reading(name.c_str()), HasSubstr(damage.second));
  }
}

TEST_F(SpecimenFile, NoticesAFlippedBit) {
  write_specimen(file("s.h5"), sample());
  std::FILE* raw = std::fopen(file("s.h5").c_str(), "r+b");
  ASSERT_NE(raw, nullptr);
  const long middle = static_cast<long>(std::filesystem::file_size(file("s.h5")) / 2);
  std::fseek(raw, middle, SEEK_SET);
  const int byte = std::fgetc(raw);
  std::fseek(raw, middle, SEEK_SET);
  std::fputc(byte ^ 1, raw);
  std::fclose(raw);
  EXPECT_THAT(refusal([&] { specimens::read_specimen(file("s.h5")); }), testing::Not("(accepted)"));
}

TEST(Inspect, HasTheContractsKeys) {
  const nlohmann::json found = to_json(inspect(sample()));
  for (const char* key :
       {"elements", "links", "mean_interior_coordination", "interaction_radius_factor", "solid_fraction",
        "radius_min", "radius_max", "fabric_eigenvalues", "size", "isotropic", "sha256"})
    EXPECT_TRUE(found.contains(key)) << key;
  EXPECT_EQ(found["elements"], 2700);
  EXPECT_EQ(found["size"], nlohmann::json({0.5, 0.25, 0.25}));
  EXPECT_TRUE(found["representative"].get<bool>());
  EXPECT_EQ(found["largest_overlap"], 0.0);
  EXPECT_NEAR(found["solid_fraction"].get<double>(), 0.42, 1e-9);
}
