// Relations between a concrete's strengths, against values worked by hand and against their own continuity.
#include <gtest/gtest.h>

#include "calibrate/lab/strength_relations.h"
#include "libdem/core/error.h"

namespace {

using lab::ConfinementRule;
using lab::RateRule;

TEST(RateFactor, OfModelCode2010IsTheHandComputedOne) {
  // (1/1e-6)^0.018 = 10^0.108; 0.0062 (100/1e-6)^(1/3) = 0.0062 * 464.159.
  EXPECT_NEAR(lab::rate_factor_in_tension(RateRule::model_code_2010, 1, 30e6), 1.28233, 1e-5);
  EXPECT_NEAR(lab::rate_factor_in_tension(RateRule::model_code_2010, 100, 30e6), 2.87779, 1e-5);
  // (3/30e-6)^0.014 = 10^0.07; 0.012 (300/30e-6)^(1/3) = 0.012 * 215.443.
  EXPECT_NEAR(lab::rate_factor_in_compression(RateRule::model_code_2010, 3, 30e6), 1.17490, 1e-5);
  EXPECT_NEAR(lab::rate_factor_in_compression(RateRule::model_code_2010, 300, 30e6), 2.58532, 1e-5);
}

TEST(RateFactor, OfOlderRulesIsTheHandComputedOne) {
  // fc 30 MPa: delta = 1/28, (3e-3/3e-6)^(1.016/28) = 10^(3.048/28); delta = 1/25, (1e-2/1e-6)^(1/25) =
  // 10^(4/25).
  EXPECT_NEAR(lab::rate_factor_in_tension(RateRule::model_code_1990, 3e-3, 30e6), 1.28486, 1e-4);
  EXPECT_NEAR(lab::rate_factor_in_tension(RateRule::malvar_ross_1998, 1e-2, 30e6), 1.44544, 1e-5);
  // alpha = 1/32, (3/30e-6)^(1.026/32) = 10^(5.13/32).
  EXPECT_NEAR(lab::rate_factor_in_compression(RateRule::model_code_1990, 3, 30e6), 1.44648, 1e-4);
}

TEST(RateFactor, JoinsItsBranchesAndIsNeverBelowTheStaticStrength) {
  const struct {
    RateRule rule;
    double knee;
  } tension[] = {
      {RateRule::model_code_2010, 10}, {RateRule::model_code_1990, 30}, {RateRule::malvar_ross_1998, 1}};
  for (const auto& [rule, knee] : tension) {
    const double below = lab::rate_factor_in_tension(rule, knee, 40e6);
    EXPECT_NEAR(lab::rate_factor_in_tension(rule, knee * 1.000001, 40e6), below, 0.012 * below);
    EXPECT_EQ(lab::rate_factor_in_tension(rule, 1e-8, 40e6), 1);
  }
  for (const RateRule rule : {RateRule::model_code_2010, RateRule::model_code_1990}) {
    const double below = lab::rate_factor_in_compression(rule, 30, 40e6);
    EXPECT_NEAR(lab::rate_factor_in_compression(rule, 30.00003, 40e6), below, 0.012 * below);
    EXPECT_EQ(lab::rate_factor_in_compression(rule, 1e-8, 40e6), 1);
  }
}

TEST(RateFactor, RefusesWhatIsNotPositive) {
  EXPECT_THROW(lab::rate_factor_in_tension(RateRule::model_code_2010, 0, 30e6), dem::InputError);
  EXPECT_THROW(lab::rate_factor_in_compression(RateRule::model_code_1990, 1, -1), dem::InputError);
}

TEST(BendingOverTension, IsTheHandComputedOne) {
  // h = 100 mm: 0.06 * 100^0.7 = 1.50713.
  EXPECT_NEAR(lab::bending_over_tension_model_code(0.1), 2.50713 / 1.50713, 1e-5);
  EXPECT_NEAR(lab::bending_over_tension_eurocode(0.1), 1.5, 1e-12);
  EXPECT_EQ(lab::bending_over_tension_eurocode(0.8), 1);
}

TEST(ConfinedStrength, IsTheHandComputedOne) {
  EXPECT_NEAR(lab::confined_strength(ConfinementRule::richart_1928, 0.25), 2.025, 1e-12);
  EXPECT_NEAR(lab::confined_strength(ConfinementRule::xie_1995, 0.25), 2.50998, 1e-5);
  EXPECT_NEAR(lab::confined_strength(ConfinementRule::imran_1996, 0.25), 2.15860, 1e-5);
  for (const auto rule :
       {ConfinementRule::richart_1928, ConfinementRule::xie_1995, ConfinementRule::imran_1996})
    EXPECT_EQ(lab::confined_strength(rule, 0), 1);
}

TEST(ResidualStrain, IsTheHandComputedOne) {
  EXPECT_NEAR(lab::residual_strain_karsan_jirsa(1), 0.275, 1e-12);
  EXPECT_NEAR(lab::residual_strain_karsan_jirsa(3), 1.541, 1e-12);
  EXPECT_NEAR(lab::residual_strain_karsan_jirsa(2 - 1e-9), lab::residual_strain_karsan_jirsa(2), 0.01);
}

}  // namespace
