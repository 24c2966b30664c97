// The moduli that a pack has for finite elements coupled to it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "impact/coupling/pack_moduli.h"
#include "libdem/core/error.h"
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
  RecordProperty("bulk_membrane_flexural", std::to_string(*moduli.bulk) + " " + std::to_string(moduli.membrane) +
                                               " " + std::to_string(moduli.flexural));
  virtual_tests::ElasticOptions options;
  options.axis = 0;
  EXPECT_EQ(moduli.membrane, virtual_tests::run_elastic(thin, card, options).young_modulus);
  EXPECT_GT(*moduli.bulk, moduli.membrane) << "faces are softer";
  EXPECT_GT(moduli.membrane, moduli.flexural) << "and bending feels them most";
  EXPECT_GT(moduli.flexural, 0.75 * *moduli.bulk);
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
