// Brazilian splitting of an elastic disc against the closed form, and of concrete: ledger, rate, resume.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "specimens/packing.h"
#include "specimens/virtual_tests/catalogue.h"
#include "specimens/virtual_tests/elastic.h"
#include "tests/verification/rig_checks.h"

using virtual_tests::SplittingOptions;
using virtual_tests::TestOutcome;

namespace {

specimens::Specimen disc_of(std::uint64_t seed) {
  specimens::PackingOptions packing;
  packing.shape = specimens::Shape::cylinder;
  packing.size = dem::Vec3(0.15, 0.15, 0.15);
  packing.elements = 2700;
  packing.threads = 1;
  packing.seed = seed;
  return specimens::make_specimen(packing);
}

const specimens::Specimen& disc() {
  static const specimens::Specimen made = disc_of(1);
  return made;
}

}  // namespace

TEST(Splitting, OfElasticDiscsStretchesAndShortensTheMiddleAsTheClosedForm) {
  // In the middle of a disc 2 P / (pi D L) pulls sideways, three times as much presses along the load. The
  // gauge is as large as a laboratory's, a fifth of the diameter, and holds some hundred elements: single
  // specimens scatter by a fifth.
  double sideways = 0, along = 0;
  constexpr int count = 6;
  for (int seed = 1; seed <= count; ++seed) {
    const specimens::Specimen specimen = disc_of(static_cast<std::uint64_t>(seed));
    SplittingOptions options;
    options.run.expected_strength = 3e6;
    options.run.max_control = 1e-9;
    const TestOutcome elastic = virtual_tests::run_test(specimen, rig_checks::unbreakable(), options);
    const auto moduli = virtual_tests::run_elastic(specimen, rig_checks::unbreakable());
    const double e = moduli.young_modulus, nu = moduli.poisson_ratio;
    const std::size_t last = elastic.curve.rows() - 1;
    const double stress = elastic.curve.column("stress")[last];
    sideways += elastic.curve.column("strain_side")[last] * e / stress / (1 + 3 * nu) / count;
    along -= elastic.curve.column("strain_load")[last] * e / stress / (3 + nu) / count;
  }
  RecordProperty("sideways", std::to_string(sideways));
  RecordProperty("along", std::to_string(along));
  EXPECT_NEAR(sideways, 1, 0.1);
  EXPECT_NEAR(along, 1, 0.1);
}

TEST(Splitting, ClosesItsLedgerAndIsQuasiStatic) {
  const TestOutcome found = rig_checks::usual(disc(), SplittingOptions{});
  rig_checks::expect_sound(found);
  const double tension_of_links = dem::MaterialCard{}.tensile_strength;
  EXPECT_GT(found.value("splitting_strength"), 0.5 * tension_of_links);
  EXPECT_LT(found.value("splitting_strength"), 2 * tension_of_links);
}

TEST(Splitting, BreaksTheLoadedPlane) {
  const TestOutcome& found = rig_checks::usual(disc(), SplittingOptions{});
  double weight = 0, square = 0;
  for (std::size_t i = 0; i < disc().elements(); ++i) {
    const double aside = disc().centres[i].y() - 0.075, d = found.fields.damage[i];
    weight += d, square += d * aside * aside;
  }
  EXPECT_LT(std::sqrt(square / weight), 0.025);
}

TEST(Splitting, HalvingItsSpeedMovesThePeakByLessThanThreePercent) {
  rig_checks::expect_rate_does_not_matter(disc(), SplittingOptions{});
}

TEST(Splitting, StoppedAndGoneOnGivesTheSameBitsOnAnyThreads) {
  rig_checks::expect_resumes(disc(), SplittingOptions{});
}
