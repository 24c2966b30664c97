// Columns, bootstrap intervals, references and trends, against closed forms and published data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "libdem/core/random.h"
#include "study/statistics/bootstrap.h"
#include "study/statistics/reference_test.h"
#include "study/statistics/summary.h"

namespace {

using namespace study::statistics;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double mean(std::span<const double> values) { return summarise(values).mean; }
double deviation(std::span<const double> values) { return summarise(values).standard_deviation; }

// Eleven values without symmetry; the intervals below are SciPy 1.10's stats.bootstrap with 200,000 resamples.
const std::vector<double> lopsided = {27.0, 31.5, 30.2, 29.9, 33.1, 30.2, 41.0, 36.3, 30.2, 45.1, 38.8};

}  // namespace

TEST(Summary, OfAColumn) {
  const Summary s = summarise(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.count, 8u);
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_NEAR(s.standard_deviation, std::sqrt(32.0 / 7), 1e-14);
  EXPECT_DOUBLE_EQ(s.min, 2);
  EXPECT_DOUBLE_EQ(s.max, 9);
  EXPECT_DOUBLE_EQ(s.spread, 7.0 / 5);
}

TEST(Summary, OfOneValueHasNoDeviationAndOfNoneThereIsNone) {
  const std::vector<double> with_gap = {1, no_number, 2, HUGE_VAL};
  EXPECT_TRUE(std::isnan(summarise(std::vector<double>({3})).standard_deviation));
  EXPECT_TRUE(std::isnan(summarise(std::vector<double>({-1, 1})).spread));
  EXPECT_THROW(summarise({}), std::invalid_argument);
  EXPECT_THROW(summarise(with_gap), std::invalid_argument);
  EXPECT_THAT(finite_of(with_gap), testing::ElementsAre(1, 2));
}

TEST(Summary, QuantilesAreThoseOfR) {
  const std::vector<double> ten = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_DOUBLE_EQ(quantile(ten, 0.25), 3.25);
  EXPECT_DOUBLE_EQ(quantile(ten, 0.5), 5.5);
  EXPECT_DOUBLE_EQ(quantile(ten, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(ten, 1), 10);
}

TEST(Bootstrap, AgreesWithSciPyOnLopsidedValues) {
  BootstrapOptions options;
  options.resamples = 40000;
  const Interval mean_bca = bootstrap_interval(lopsided, mean, options),
                 deviation_bca = bootstrap_interval(lopsided, deviation, options);
  EXPECT_NEAR(mean_bca.low, 31.227, 0.08);
  EXPECT_NEAR(mean_bca.high, 37.727, 0.15);
  EXPECT_NEAR(deviation_bca.low, 3.899, 0.08);
  EXPECT_NEAR(deviation_bca.high, 7.932, 0.08);
  options.kind = IntervalKind::percentile;
  const Interval mean_percentile = bootstrap_interval(lopsided, mean, options),
                 deviation_percentile = bootstrap_interval(lopsided, deviation, options);
  EXPECT_NEAR(mean_percentile.low, 30.964, 0.08);
  EXPECT_NEAR(mean_percentile.high, 37.300, 0.08);
  EXPECT_NEAR(deviation_percentile.low, 2.836, 0.08);
  EXPECT_NEAR(deviation_percentile.high, 7.096, 0.08);
}

TEST(Bootstrap, HoldsTheMeanOfNormalDrawsAboutAsOftenAsItSays) {
  dem::Random random(11);
  BootstrapOptions options;
  options.resamples = 600;
  int held = 0;
  constexpr int trials = 600;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> values(30);
    for (double& value : values) value = 7 + 2 * random.normal();
    options.seed = static_cast<std::uint64_t>(trial) + 1;
    const Interval interval = bootstrap_interval(values, mean, options);
    held += interval.low <= 7 && 7 <= interval.high;
  }
  // 94% is what 30 values give; 600 trials know it to 1%.
  EXPECT_GT(held, 0.91 * trials);
  EXPECT_LT(held, 0.97 * trials);
}

TEST(Bootstrap, SameSeedGivesTheSameBitsAnotherSeedDoesNot) {
  BootstrapOptions options;
  const Interval a = bootstrap_interval(lopsided, mean, options),
                 b = bootstrap_interval(lopsided, mean, options);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  options.seed = 2;
  EXPECT_NE(bootstrap_interval(lopsided, mean, options).low, a.low);
}

TEST(Bootstrap, SaysNothingOfTwoValuesAndRefusesNonsense) {
  EXPECT_TRUE(std::isnan(bootstrap_interval(std::vector<double>({1, 2}), mean).low));
  BootstrapOptions certain, few;
  certain.level = 1, few.resamples = 10;
  EXPECT_THROW(bootstrap_interval(lopsided, mean, certain), std::invalid_argument);
  EXPECT_THROW(bootstrap_interval(lopsided, mean, few), std::invalid_argument);
  const Interval equal = bootstrap_interval(std::vector<double>(8, 3.0), mean);
  EXPECT_EQ(equal.low, 3);
  EXPECT_EQ(equal.high, 3);
}

TEST(Reference, OutsiderIsFoundByTheTDistribution) {
  const std::vector<double> reference = {9, 10, 11, 10};  // mean 10, deviation sqrt(2/3)
  const auto test = outsider(13, reference);
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->deviation, 0.3, 1e-14);
  EXPECT_NEAR(test->t, 3 / std::sqrt(2.0 / 3 * 1.25), 1e-13);
  // Three degrees: P(|T| > t) = 1 - 2/pi (atan(t/sqrt 3) + (t/sqrt 3)/(1 + t^2/3)).
  const double x = test->t / std::sqrt(3.0);
  EXPECT_NEAR(test->p, 1 - 2 / M_PI * (std::atan(x) + x / (1 + x * x)), 1e-12);
  // The smallest visible deviation is where p is 0.05.
  const auto edge = outsider(10 * (1 + smallest_visible_deviation(reference)), reference);
  EXPECT_NEAR(edge->p, 0.05, 1e-10);
  EXPECT_FALSE(outsider(13, std::vector<double>({5, 5, 5})));
  EXPECT_FALSE(outsider(13, std::vector<double>({5, 6})));
  EXPECT_FALSE(outsider(no_number, reference));
}

TEST(Reference, HolmAdjustsForSeveralQuestions) {
  EXPECT_THAT(holm(std::vector<double>{0.01, 0.04, 0.03, 0.005}),
              testing::Pointwise(testing::DoubleNear(1e-15), {0.03, 0.06, 0.06, 0.02}));
  const std::vector<double> with_gap = holm(std::vector<double>{0.04, no_number, 0.9});
  EXPECT_DOUBLE_EQ(with_gap[0], 0.08);
  EXPECT_TRUE(std::isnan(with_gap[1]));
  EXPECT_DOUBLE_EQ(with_gap[2], 0.9);
}

TEST(Reference, TrendOfAnscombesFirstSet) {  // The American Statistician 27 (1973)
  const std::vector<double> x = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const auto line = trend(x, y);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 0.5000909090909091, 1e-13);
  EXPECT_NEAR(line->intercept, 3.0000909090909, 1e-12);
  EXPECT_NEAR(line->standard_error, 0.11790550059563408, 1e-13);
  EXPECT_NEAR(line->p, 0.00216962887307879, 1e-13);
  EXPECT_NEAR(line->r_squared, 0.8164205163448399 * 0.8164205163448399, 1e-13);
  EXPECT_FALSE(trend(std::vector<double>({1, 1, 1}), std::vector<double>({1, 2, 3})));
  EXPECT_FALSE(trend(std::vector<double>({1, 2, 3}), std::vector<double>({2, 4, 6})));
  EXPECT_THROW(trend(x, std::vector<double>({1})), std::invalid_argument);
}
