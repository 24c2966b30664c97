// Directions of links against the uniform distribution.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libdem/core/random.h"
#include "study/statistics/orientation.h"

namespace {

using namespace study::statistics;
using dem::Vec3;

std::vector<Vec3> random_directions(std::size_t count, double stretch) {
  dem::Random random(3);
  std::vector<Vec3> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    directions.emplace_back(stretch * x, y, z);
  }
  return directions;
}

}  // namespace

TEST(Orientation, UniformDirectionsFillAllCellsAlike) {
  const auto histogram = orientation_histogram(random_directions(20000, 1), 6, 12, 0);
  EXPECT_EQ(histogram.total, 20000);
  const Uniformity test = uniformity(histogram);
  EXPECT_EQ(test.degrees, 71u);
  EXPECT_GT(test.p, 0.01);
  EXPECT_NEAR(test.deviation, test.expected_deviation, 0.3 * test.expected_deviation);
  for (const double ring : histogram.relative_by_theta()) EXPECT_NEAR(ring, 1, 0.06);
  for (const double sector : histogram.relative_by_phi()) EXPECT_NEAR(sector, 1, 0.08);
}

TEST(Orientation, APreferredDirectionIsSeen) {
  const auto histogram = orientation_histogram(random_directions(5000, 1.3), 6, 12, 0);
  EXPECT_LT(uniformity(histogram).p, 1e-6);
  EXPECT_GT(histogram.relative_by_theta().front(), 1.2);  // theta 0 is x, where they are stretched to
  EXPECT_LT(histogram.relative_by_theta().back(), 0.9);
}

TEST(Orientation, OppositeDirectionsAreOneLink) {
  const std::vector<Vec3> ends = {{0.3, -0.2, 0.5}, {-0.6, 0.4, -1.0}};
  const auto histogram = orientation_histogram(ends, 3, 8);
  EXPECT_THAT(histogram.counts, testing::Contains(2));
  EXPECT_EQ(histogram.total, 2);
}

TEST(Orientation, CellsAreCountedFromTheAxesThatTheHeaderNames) {
  // Polar axis x: phi counts from y towards z.
  const std::vector<Vec3> one = {{0.1, 1, 0.1}};
  const auto histogram = orientation_histogram(one, 2, 4, 0);
  EXPECT_EQ(histogram.relative(1, 0), 8);
  auto sum = histogram;
  add(sum, orientation_histogram(std::vector<Vec3>{{0.1, -0.1, 1}}, 2, 4, 0));
  EXPECT_EQ(sum.total, 2);
  EXPECT_EQ(sum.relative(1, 0), 4);
  EXPECT_EQ(sum.relative(1, 1), 4);
}

TEST(Orientation, ChiSquareIsPearsons) {
  OrientationHistogram histogram{1, 4, {30, 20, 30, 20}, 100};
  const Uniformity test = uniformity(histogram);
  EXPECT_DOUBLE_EQ(test.chi_square, 4);
  EXPECT_NEAR(test.p, 0.26146412994911, 1e-10);  // three degrees
  EXPECT_DOUBLE_EQ(test.deviation, 0.2);
  EXPECT_DOUBLE_EQ(test.expected_deviation, 0.2);
}

TEST(Orientation, RefusesNonsense) {
  EXPECT_THROW(orientation_histogram(std::vector<Vec3>{Vec3::Zero()}, 2, 2), std::invalid_argument);
  EXPECT_THROW(orientation_histogram({}, 0, 2), std::invalid_argument);
  EXPECT_THROW(orientation_histogram({}, 2, 2, 3), std::invalid_argument);
  EXPECT_THROW(uniformity(orientation_histogram({}, 2, 2)), std::invalid_argument);
  auto histogram = orientation_histogram({}, 2, 2);
  EXPECT_THROW(add(histogram, orientation_histogram({}, 2, 3)), std::invalid_argument);
}
