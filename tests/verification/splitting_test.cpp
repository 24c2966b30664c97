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

const specimens::Specimen& disc() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.shape = specimens::Shape::cylinder;
    packing.size = dem::Vec3(0.15, 0.15, 0.15);
    packing.elements = 2700;
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  return made;
}

}  // namespace

TEST(Splitting, OfAnElasticDiscStretchesAndShortensItsMiddleAsTheClosedForm) {
  SplittingOptions options;
  const TestOutcome elastic = rig_checks::elastic_part(disc(), options);
  const auto moduli = virtual_tests::run_elastic(disc(), rig_checks::unbreakable());
  const double e = moduli.young_modulus, nu = moduli.poisson_ratio;
  // In the middle of a disc 2 P / (pi D L) pulls sideways, three times as much presses along the load.
  const std::size_t last = elastic.curve.rows() - 1;
  const double stress = elastic.curve.column("stress")[last];
  const double sideways = elastic.curve.column("strain_side")[last] * e / stress;
  const double along = elastic.curve.column("strain_load")[last] * e / stress;
  RecordProperty("sideways", std::to_string(sideways / (1 + 3 * nu)));
  RecordProperty("along", std::to_string(along / -(3 + nu)));
  // A gauge of a fifth of the diameter, in a disc of 14 elements across.
  EXPECT_NEAR(sideways, 1 + 3 * nu, 0.1 * (1 + 3 * nu));
  EXPECT_NEAR(along, -(3 + nu), 0.1 * (3 + nu));
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
