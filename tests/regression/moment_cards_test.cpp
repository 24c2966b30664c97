// The shipped cards of the law that transfers moments, on one small prism with free ends.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "specimens/packing.h"
#include "specimens/virtual_tests/uniaxial.h"
#include "tests/regression/kept.h"

namespace {

class MomentCards : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(MomentCards, PeaksOnAPrismAreTheKeptOnes) {
  const std::string card_name = GetParam();
  specimens::PackingOptions packing;
  packing.size = {0.4, 0.2, 0.2};
  packing.elements = 1400;
  const specimens::Specimen prism = specimens::make_specimen(packing);
  const dem::MaterialCard card =
      dem::read_card(std::filesystem::path(SPALL_SOURCE_DIR) / "data/cards" / (card_name + ".toml"));
  ASSERT_EQ(card.link_law, dem::LinkLawKind::moment_transfer);
  virtual_tests::UniaxialOptions options;
  options.stop_at = 0.9;
  const auto tension = virtual_tests::run_uniaxial(prism, card, options);
  options.loading = virtual_tests::Loading::compression;
  const auto compression = virtual_tests::run_uniaxial(prism, card, options);
  const auto expect_kept = [&](const char* figure, double value) {
    EXPECT_TRUE(regression::is_kept("prism-" + card_name, figure, value));
  };
  expect_kept("tension_peak_stress", tension.peak_stress);
  expect_kept("tension_peak_strain", tension.peak_strain);
  expect_kept("compression_peak_stress", compression.peak_stress);
  expect_kept("compression_peak_strain", compression.peak_strain);
  EXPECT_LT(compression.energy_balance_error, 0.005);
  EXPECT_GT(compression.peak_stress, 10 * tension.peak_stress)
      << "brittle tension at the ratio of real concretes";
}

INSTANTIATE_TEST_SUITE_P(Shipped, MomentCards, testing::Values("c25-moment", "bam-m7-moment", "c60-moment"),
                         [](const auto& card) { return std::string(card.param).substr(0, 3); });
