// The moduli that a pack has for finite elements coupled to it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "impact/coupling/pack_moduli.h"
#include "libdem/core/error.h"
#include "specimens/extract.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"

namespace {

using dem::Vec3;

specimens::Specimen plate(double thickness) {
  specimens::PackingOptions packing;
  packing.size = Vec3(0.3, 0.2, thickness);
  packing.elements = static_cast<std::size_t>(packing.size.prod() / std::pow(0.0125, 3));
  packing.threads = 1;
  specimens::Specimen pack = specimens::pack(packing);
  specimens::link(pack, 1);
  return pack;
}

}  // namespace

TEST(PackModuli, FallFromTheInsideToTheSectionToBending) {
  const dem::MaterialCard card;
  const specimens::Specimen thin = plate(0.14);
  const coupling::PackModuli moduli = coupling::measure_moduli(thin, card, 2, 0);
  ASSERT_TRUE(moduli.bulk);
  RecordProperty("bulk_membrane_flexural", std::to_string(*moduli.bulk) + " " +
                                               std::to_string(moduli.membrane) + " " +
                                               std::to_string(moduli.flexural));
  virtual_tests::ElasticOptions options;
  options.axis = 0;
  const double with_sides = virtual_tests::run_elastic(thin, card, options).young_modulus;
  EXPECT_GT(moduli.membrane, with_sides)
      << "the sides of the cell are soft too, those of the structure far away";
  EXPECT_LT(moduli.membrane, 1.1 * with_sides);
  EXPECT_GT(*moduli.bulk, moduli.membrane) << "faces are softer";
  EXPECT_GT(moduli.membrane, moduli.flexural) << "and bending feels them most";
  EXPECT_GT(moduli.flexural, 0.75 * *moduli.bulk);
}

TEST(PackModuli, DoNotDependOnHowWideTheCellIsCut) {
  const dem::MaterialCard card;
  const specimens::Specimen wide = plate(0.14);
  const Vec3 middle = 0.5 * wide.size;
  const specimens::Specimen narrow =
      specimens::extract(wide, specimens::Shape::box, middle, Vec3(0.3, 0.13, 0.14));
  const coupling::PackModuli of_wide = coupling::measure_moduli(wide, card, 2, 0),
                             of_narrow = coupling::measure_moduli(narrow, card, 2, 0);
  EXPECT_NEAR(of_narrow.membrane, of_wide.membrane, 0.02 * of_wide.membrane);
  EXPECT_NEAR(of_narrow.flexural, of_wide.flexural, 0.02 * of_wide.flexural);
}

TEST(PackModuli, RefuseWhatIsNoStrip) {
  const dem::MaterialCard card;
  const auto refusal = [&](const specimens::Specimen& cell, int thickness_axis, int along) -> std::string {
    try {
      coupling::measure_moduli(cell, card, thickness_axis, along);
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "";
  };
  const specimens::Specimen flat = plate(0.1);
  EXPECT_FALSE(coupling::measure_moduli(flat, card, 2, 0).bulk) << "eight elements thick: no inside";
  EXPECT_THAT(refusal(flat, 2, 2), testing::HasSubstr("two axes are the same"));
  EXPECT_THAT(refusal(plate(0.14), 0, 1), testing::HasSubstr("1.5 times as long as thick"));
}
