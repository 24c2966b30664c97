// The shipped cards of the law that transfers moments, on one small prism with free ends.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "specimens/packing.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace {

struct Kept {
  const char* card;
  double tension, tension_strain, compression, compression_strain;  ///< peaks [Pa], strains there [-]
};

class MomentCards : public testing::TestWithParam<Kept> {};

double relative(double value, double kept) { return std::abs(value / kept - 1); }

}  // namespace

TEST_P(MomentCards, PeaksOnAPrismAreTheKeptOnes) {
  const Kept& kept = GetParam();
  specimens::PackingOptions packing;
  packing.size = {0.4, 0.2, 0.2};
  packing.elements = 1400;
  const specimens::Specimen prism = specimens::make_specimen(packing);
  const dem::MaterialCard card =
      dem::read_card(std::filesystem::path(SPALL_SOURCE_DIR) / "data/cards" / kept.card);
  ASSERT_EQ(card.link_law, dem::LinkLawKind::moment_transfer);
  virtual_tests::UniaxialOptions options;
  options.stop_at = 0.9;
  const auto tension = virtual_tests::run_uniaxial(prism, card, options);
  options.loading = virtual_tests::Loading::compression;
  const auto compression = virtual_tests::run_uniaxial(prism, card, options);
  // Set with the cards' first fit. Single compressive peaks move a little with the instruction set.
  EXPECT_LT(relative(tension.peak_stress, kept.tension), 0.005) << tension.peak_stress;
  EXPECT_LT(relative(tension.peak_strain, kept.tension_strain), 0.03) << tension.peak_strain;
  EXPECT_LT(relative(compression.peak_stress, kept.compression), 0.02) << compression.peak_stress;
  EXPECT_LT(relative(compression.peak_strain, kept.compression_strain), 0.10) << compression.peak_strain;
  EXPECT_LT(compression.energy_balance_error, 0.005);
  EXPECT_GT(compression.peak_stress, 10 * tension.peak_stress)
      << "brittle tension at the ratio of real concretes";
}

INSTANTIATE_TEST_SUITE_P(Shipped, MomentCards,
                         testing::Values(Kept{"c25-moment.toml", 2.651e6, 0.1626e-3, 31.28e6, 1.740e-3},
                                         Kept{"bam-m7-moment.toml", 3.635e6, 0.1641e-3, 49.99e6, 2.293e-3},
                                         Kept{"c60-moment.toml", 4.564e6, 0.1750e-3, 67.26e6, 2.762e-3}),
                         [](const auto& kept) { return std::string(kept.param.card).substr(0, 3); });
