// Tests of effects against published data and other programs' figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libdem/core/random.h"
#include "study/statistics/analysis_of_variance.h"
#include "study/statistics/rank_test.h"
#include "study/statistics/words.h"

namespace {

using namespace study::statistics;

// NIST Statistical Reference Datasets, analysis of variance, SiRstv: resistivity of silicon, five instruments.
const Groups silicon = {{196.3052, 196.1240, 196.1890, 196.2569, 196.3403},
                        {196.3042, 196.3825, 196.1669, 196.3257, 196.0422},
                        {196.1303, 196.2005, 196.2889, 196.0343, 196.1811},
                        {196.2795, 196.1748, 196.1494, 196.1485, 195.9885},
                        {196.2119, 196.1051, 196.1850, 196.0052, 196.2090}};
const Groups unequal = {
    {27.0, 31.5, 30.2, 29.9, 33.1}, {24.1, 22.7, 25.9}, {30.2, 41.0, 36.3, 30.2, 45.1, 38.8}};

// Yields of peas, blocks of four plots with nitrogen, phosphate, potash or not (Venables and Ripley's `npk`).
const std::vector<double> yield = {49.5, 62.8, 46.8, 57.0, 59.8, 58.5, 55.5, 56.0, 62.8, 55.8, 69.5, 55.0,
                                   62.0, 48.8, 45.5, 44.2, 52.0, 51.5, 49.8, 48.8, 57.2, 59.0, 53.2, 56.0};
const std::vector<Factor> treatments = {
    {"block", {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5}},
    {"N", {0, 1, 0, 1, 1, 1, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 0, 0}},
    {"P", {1, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0}},
    {"K", {1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0}}};

void expect_terms(const MainEffects& effects, const std::vector<std::array<double, 4>>& wanted) {
  ASSERT_EQ(effects.terms.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto& [degrees, squares, F, p] = wanted[k];
    const Term& term = effects.terms[k];
    EXPECT_EQ(static_cast<double>(term.degrees), degrees) << term.factor;
    EXPECT_NEAR(term.sum_of_squares, squares, 1e-5) << term.factor;
    EXPECT_NEAR(term.F, F, 1e-5) << term.factor;
    EXPECT_NEAR(term.p, p, 1e-5) << term.factor;
  }
}

}  // namespace

TEST(AnalysisOfVariance, AgreesWithNistsCertifiedValues) {
  const auto test = one_way(silicon);
  ASSERT_TRUE(test);
  EXPECT_EQ(test->degrees_between, 4u);
  EXPECT_EQ(test->degrees_within, 20u);
  EXPECT_NEAR(test->F, 1.18046237440255, 1e-9);
  EXPECT_NEAR(test->sum_between, 5.11462616e-02, 1e-11);
  EXPECT_NEAR(test->sum_within, 2.1663656e-01, 1e-11);
  EXPECT_NEAR(test->eta_squared, 1.90999039051129e-01, 1e-10);
  EXPECT_NEAR(test->p, 0.349447493402, 1e-9);
}

TEST(AnalysisOfVariance, GroupsOfOneValueUseTheScatterOfTheOthers) {
  // Two groups are a t test: t = d / (s sqrt(1 + 1/n)), F = t^2.
  const auto test = one_way({{9, 10, 11, 10}, {13}});
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->F, 9 / (2.0 / 3 * 1.25), 1e-12);
  EXPECT_FALSE(one_way({{1}, {2}, {3}}));
  EXPECT_FALSE(one_way({{1, 2, 3}}));
  EXPECT_FALSE(one_way({{1, 1}, {2, 2}}));
  EXPECT_FALSE(one_way({}));
}

TEST(AnalysisOfVariance, FalseAlarmsComeAsOftenAsTheySay) {
  dem::Random random(5);
  int alarms = 0, rank_alarms = 0, welch_alarms = 0;
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    Groups groups(3, std::vector<double>(6));
    for (auto& group : groups)
      for (double& value : group) value = random.normal();
    alarms += one_way(groups)->p < 0.05;
    rank_alarms += kruskal_wallis(groups)->p < 0.05;
    welch_alarms += welch(groups)->p < 0.05;
  }
  EXPECT_NEAR(alarms, 0.05 * trials, 45);  // three deviations of the count
  EXPECT_NEAR(welch_alarms, 0.05 * trials, 60);
  EXPECT_NEAR(rank_alarms, 0.045 * trials, 60);
}

TEST(AnalysisOfVariance, WelchAndKruskalWallisAgreeWithStatsmodelsAndSciPy) {
  const auto by_welch = welch(unequal);
  ASSERT_TRUE(by_welch);
  EXPECT_NEAR(by_welch->F, 16.10012642049014, 1e-10);
  EXPECT_NEAR(by_welch->degrees_within, 7.048052888864177, 1e-10);
  EXPECT_NEAR(by_welch->p, 0.002354784012550602, 1e-12);
  EXPECT_FALSE(welch({{1, 2}, {3}}));
  const auto by_rank = kruskal_wallis(unequal);  // with a tie of three
  ASSERT_TRUE(by_rank);
  EXPECT_NEAR(by_rank->H, 8.77235772357723, 1e-10);
  EXPECT_EQ(by_rank->degrees, 2u);
  EXPECT_NEAR(by_rank->p, 0.012448204768265376, 1e-12);
  EXPECT_FALSE(kruskal_wallis({{1, 1}, {1}}));
}

TEST(MainEffects, OfABalancedDesignAreTheTextbooks) {
  const auto effects = main_effects(yield, treatments);
  ASSERT_TRUE(effects);
  EXPECT_EQ(effects->residual_degrees, 15u);
  expect_terms(*effects, {{5, 343.295, 4.287882, 0.012722},
                          {1, 189.281667, 11.820992, 0.003660},
                          {1, 8.401667, 0.524700, 0.479990},
                          {1, 95.201667, 5.945521, 0.027667}});
  EXPECT_NEAR(effects->terms[1].partial_eta_squared, 189.281667 / (189.281667 + 240.185), 1e-8);
  EXPECT_NEAR(effects->terms[1].eta_squared, 189.281667 / effects->total_sum, 1e-8);
}

TEST(MainEffects, OfAnUnbalancedDesignAreThoseOfTypeTwo) {  // statsmodels 0.13, anova_lm(typ=2)
  std::vector<double> fewer;
  std::vector<Factor> levels = treatments;
  for (Factor& factor : levels) factor.levels.clear();
  for (std::size_t row = 0; row < yield.size(); ++row) {
    if (row == 0 || row == 5 || row == 6 || row == 13 || row == 22) continue;
    fewer.push_back(yield[row]);
    for (std::size_t f = 0; f < levels.size(); ++f) levels[f].levels.push_back(treatments[f].levels[row]);
  }
  const auto effects = main_effects(fewer, levels);
  ASSERT_TRUE(effects);
  EXPECT_EQ(effects->residual_degrees, 10u);
  expect_terms(*effects, {{5, 272.027600136, 2.587846189, 0.094152497},
                          {1, 191.362993636, 9.102348318, 0.012961486},
                          {1, 9.349606716, 0.444722228, 0.519941802},
                          {1, 100.301466487, 4.770927061, 0.053857558}});
}

TEST(MainEffects, SayWhenAFactorCannotBeToldFromAnother) {
  const std::vector<double> values = {1, 2, 3, 5, 4, 6};
  const auto effects = main_effects(values, {{"shape", {0, 0, 0, 1, 1, 1}}, {"size", {7, 7, 7, 3, 3, 3}}});
  ASSERT_TRUE(effects);
  for (const Term& term : effects->terms) {
    EXPECT_EQ(term.degrees, 0u);
    EXPECT_TRUE(std::isnan(term.F));
    EXPECT_THAT(words_of(term, effects->residual_degrees), testing::HasSubstr("cannot be said"));
  }
  EXPECT_FALSE(main_effects(values, {{"each its own", {0, 1, 2, 3, 4, 5}}}));
  EXPECT_THROW(main_effects(values, {{"short", {0, 1}}}), std::invalid_argument);
}

TEST(MainEffects, OfOneFactorAreTheOneWayTest) {
  std::vector<double> values;
  Factor instrument{"instrument", {}};
  for (std::size_t g = 0; g < silicon.size(); ++g)
    for (const double value : silicon[g]) values.push_back(value), instrument.levels.push_back(g);
  EXPECT_NEAR(main_effects(values, {instrument})->terms[0].F, 1.18046237440255, 1e-9);
}

TEST(Words, ClaimNoMoreThanTheTestShows) {
  EXPECT_EQ(
      words_of("instrument", one_way(silicon)),
      "No effect of instrument shown beyond the scatter: F(4, 20) = 1.18, p = 0.35, large (eta^2 = 0.19).");
  EXPECT_THAT(words_of("shape", one_way(unequal)), testing::StartsWith("Effect of shape shown: F(2, 11) = "));
  EXPECT_THAT(words_of("shape", std::nullopt), testing::HasSubstr("cannot be said"));
  EXPECT_EQ(p_words(1e-7), "p < 0.001");
  EXPECT_EQ(p_words(0.0123), "p = 0.012");
  EXPECT_EQ(effect_size_words(0.05), "small");
}
