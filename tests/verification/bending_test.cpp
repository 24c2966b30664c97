// Three-point bending: the stiffness of a beam, the notch, ledger, rate, resume.
#include <gtest/gtest.h>

#include <cmath>

#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/saw_cut.h"
#include "tests/verification/rig_checks.h"

using virtual_tests::BendingOptions;
using virtual_tests::TestOutcome;

namespace {

const specimens::Specimen& beam() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.size = dem::Vec3(0.4, 0.1, 0.1);
    packing.elements = 2700;
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  return made;
}

BendingOptions notched() {
  BendingOptions options;
  options.notch = 0.03;
  options.run.stop_at = 0.3;
  return options;
}

}  // namespace

TEST(Bending, OfAnElasticBeamIsAsStiffAsTimoshenkos) {
  const BendingOptions options;
  const TestOutcome elastic = rig_checks::elastic_part(beam(), options);
  const auto moduli = virtual_tests::run_elastic(beam(), rig_checks::unbreakable());
  const double e = moduli.young_modulus, g = e / (2 * (1 + moduli.poisson_ratio));
  const double l = 0.9 * 0.4, b = 0.1, h = 0.1;
  const double compliance = l * l * l / (4 * e * b * h * h * h) + l / (4 * 5.0 / 6 * g * b * h);
  const double stiffness = elastic.value("stiffness");
  RecordProperty("stiffness", std::to_string(stiffness * compliance));
  EXPECT_NEAR(stiffness * compliance, 1, 0.1);
}

TEST(Bending, ClosesItsLedgerAndIsQuasiStatic) {
  BendingOptions options;
  options.run.stop_at = 0.3;
  const TestOutcome& found = rig_checks::usual(beam(), options);
  rig_checks::expect_sound(found);
  EXPECT_GT(found.value("bending_strength"), 0.5 * dem::MaterialCard{}.tensile_strength);
  EXPECT_GT(found.value("fracture_energy"), 0);
}

TEST(Bending, ANotchCarriesNothingAndTheCrackGrowsFromIt) {
  const specimens::Specimen cut = virtual_tests::cut(beam(), {0, 2, 0, 0.2, 0.03, beam().element_size()});
  EXPECT_LT(cut.elements(), beam().elements());
  for (const specimens::Link& link : cut.links) {
    const dem::Vec3 &a = cut.centres[static_cast<std::size_t>(link.a)],
                    &b = cut.centres[static_cast<std::size_t>(link.b)];
    if ((a.x() - 0.2) * (b.x() - 0.2) < 0) {
      EXPECT_GT(std::max(a.z(), b.z()), 0.03);
    }
  }
  const TestOutcome& found = rig_checks::usual(beam(), notched());
  rig_checks::expect_sound(found);
  ASSERT_TRUE(found.tested.has_value());
  EXPECT_EQ(found.tested->sha256(), cut.sha256());
  double weight = 0, square = 0;
  for (std::size_t i = 0; i < cut.elements(); ++i) {
    const double aside = cut.centres[i].x() - 0.2;
    weight += found.fields.damage[i], square += found.fields.damage[i] * aside * aside;
  }
  EXPECT_LT(std::sqrt(square / weight), 0.03);
  // The mouth opens, and the sections beside the crack turn as stiff bodies: opening over deflection is
  // 4 h / l of the whole height, once the crack has run.
  const std::size_t last = found.curve.rows() - 1;
  const double ratio = found.curve.column("crack_mouth_opening")[last] / found.curve.column("deflection")[last];
  EXPECT_NEAR(ratio, 4 * 0.1 / 0.36, 0.3);
}

TEST(Bending, HalvingItsSpeedMovesThePeakByLessThanThreePercent) {
  rig_checks::expect_rate_does_not_matter(beam(), notched());
}

TEST(Bending, StoppedAndGoneOnGivesTheSameBitsOnAnyThreads) { rig_checks::expect_resumes(beam(), notched()); }
