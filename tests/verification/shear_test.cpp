// Direct shear: the stiffness of a clamped column, the normal force, ledger, rate, resume.
#include <gtest/gtest.h>

#include <cmath>

#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "tests/verification/rig_checks.h"

using virtual_tests::ShearOptions;
using virtual_tests::TestOutcome;

namespace {

specimens::Specimen block(double height, std::size_t elements) {
  specimens::PackingOptions packing;
  packing.size = dem::Vec3(0.1, 0.1, height);
  packing.elements = elements;
  packing.threads = 1;
  return specimens::make_specimen(packing);
}

const specimens::Specimen& cube() {
  static const specimens::Specimen made = block(0.1, 1400);
  return made;
}

ShearOptions pressed() {
  ShearOptions options;
  options.normal_stress = 1e6;
  return options;
}

}  // namespace

TEST(Shear, OfAnElasticColumnHeldAtItsEndsIsAsStiffAsTimoshenkos) {
  const specimens::Specimen column = block(0.25, 3000);
  ShearOptions options;
  const double size = column.element_size();
  options.axis = 2;
  options.gap = 0.25 - 2 * size;  // only the two end layers are held
  const TestOutcome elastic = rig_checks::elastic_part(column, options);
  const auto moduli = virtual_tests::run_elastic(column, rig_checks::unbreakable());
  const double e = moduli.young_modulus, g = e / (2 * (1 + moduli.poisson_ratio));
  const double l = 0.25 - size, b = 0.1;  // between the middles of the layers
  const double compliance = l * l * l / (e * b * b * b * b) + l / (5.0 / 6 * g * b * b);
  const std::size_t last = elastic.curve.rows() - 1;
  const double stiffness = elastic.curve.column("force")[last] / elastic.curve.column("displacement")[last];
  RecordProperty("stiffness", std::to_string(stiffness * compliance));
  EXPECT_NEAR(stiffness * compliance, 1, 0.1);
}

TEST(Shear, ClosesItsLedgerAndIsQuasiStatic) {
  rig_checks::expect_sound(rig_checks::usual(cube(), ShearOptions{}));
  rig_checks::expect_sound(rig_checks::usual(cube(), pressed()));
}

TEST(Shear, HoldsItsNormalStressAndRisesWithIt) {
  const TestOutcome &free = rig_checks::usual(cube(), ShearOptions{}),
                    &under = rig_checks::usual(cube(), pressed());
  EXPECT_NEAR(under.value("normal_stress_at_peak"), 1e6, 5e4);
  EXPECT_NEAR(free.value("normal_stress_at_peak"), 0, 5e4);
  EXPECT_GT(under.value("shear_strength"), 1.05 * free.value("shear_strength"));
}

TEST(Shear, HalvingItsSpeedMovesThePeakByLessThanThreePercent) {
  rig_checks::expect_rate_does_not_matter(cube(), pressed());
}

TEST(Shear, StoppedAndGoneOnGivesTheSameBitsOnAnyThreads) { rig_checks::expect_resumes(cube(), pressed()); }
