// Sobol indices of functions whose indices are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "study/statistics/sobol_indices.h"

namespace {

using namespace study::statistics;
using Point = std::vector<double>;

template <class Function>
std::vector<double> outputs_of(const SobolDesign& design, Function&& f) {
  std::vector<double> outputs;
  for (const Point& point : design.points) outputs.push_back(f(point));
  return outputs;
}

// Ishigami and Homma (1990), a = 7, b = 0.1, inputs uniform over -pi to pi.
double ishigami(const Point& u) {
  const auto x = [&](std::size_t k) { return std::numbers::pi * (2 * u[k] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

}  // namespace

TEST(SobolIndices, OfTheIshigamiFunctionAreTheKnownOnes) {
  const SobolDesign design = sobol_design(3, 2048);
  const SobolIndices indices = sobol_indices(3, outputs_of(design, ishigami), {.resamples = 300});
  const double pi4 = std::pow(std::numbers::pi, 4), pi8 = pi4 * pi4;
  const double V1 = 0.5 * std::pow(1 + 0.1 * pi4 / 5, 2), V2 = 49.0 / 8, V13 = 0.01 * pi8 * 8 / 225;
  const double V = V1 + V2 + V13;
  const std::vector<double> first = {V1 / V, V2 / V, 0}, total = {(V1 + V13) / V, V2 / V, V13 / V};
  EXPECT_NEAR(first[0], 0.3139, 5e-5);  // as published
  EXPECT_NEAR(indices.mean, 3.5, 0.02);
  EXPECT_NEAR(indices.variance, V, 0.02 * V);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices.inputs[i].first, first[i], 0.01) << i;
    EXPECT_NEAR(indices.inputs[i].total, total[i], 0.01) << i;
    EXPECT_LE(indices.inputs[i].first_interval.low, first[i]) << i;
    EXPECT_GE(indices.inputs[i].first_interval.high, first[i]) << i;
    EXPECT_LE(indices.inputs[i].total_interval.low, total[i]) << i;
    EXPECT_GE(indices.inputs[i].total_interval.high, total[i]) << i;
  }
}

TEST(SobolIndices, OfTheGFunctionAreTheKnownOnes) {  // Saltelli and Sobol (1995)
  const std::vector<double> a = {0, 1, 4.5, 9};
  const auto g = [&](const Point& u) {
    double product = 1;
    for (std::size_t k = 0; k < a.size(); ++k) product *= (std::abs(4 * u[k] - 2) + a[k]) / (1 + a[k]);
    return product;
  };
  const SobolIndices indices = sobol_indices(4, outputs_of(sobol_design(4, 2048), g), {.resamples = 100});
  double whole = 1;
  const auto part = [&](std::size_t k) { return 1 / (3 * (1 + a[k]) * (1 + a[k])); };
  for (std::size_t k = 0; k < a.size(); ++k) whole *= 1 + part(k);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(indices.inputs[k].first, part(k) / (whole - 1), 0.01) << k;
    EXPECT_NEAR(indices.inputs[k].total, part(k) * whole / (1 + part(k)) / (whole - 1), 0.01) << k;
  }
}

TEST(SobolIndices, OfASumComeCloseWithFewRowsWhateverItsMean) {
  const auto f = [](const Point& u) { return 1000 + 3 * u[0] + 2 * u[1] + u[2]; };
  const std::vector<double> wanted = {9.0 / 14, 4.0 / 14, 1.0 / 14, 0};
  double first = 0, total = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SobolDesign design = sobol_design(4, 64, seed);
    const SobolIndices indices = sobol_indices(4, outputs_of(design, f), {.resamples = 100});
    for (std::size_t i = 0; i < 4; ++i) {
      first += std::pow(indices.inputs[i].first - wanted[i], 2) / 80;
      total += std::pow(indices.inputs[i].total - wanted[i], 2) / 80;
    }
    EXPECT_EQ(indices.inputs[3].first, 0);  // an input that does nothing: exactly
    EXPECT_EQ(indices.inputs[3].total, 0);
  }
  EXPECT_LT(std::sqrt(first), 0.04);
  EXPECT_LT(std::sqrt(total), 0.04);
}

TEST(SobolIndices, AFailedRowDropsItsBasePointOnly) {
  const auto f = [](const Point& u) { return u[0] + 2 * u[1]; };
  const SobolDesign design = sobol_design(2, 16);
  std::vector<double> outputs = outputs_of(design, f);
  std::vector<double> without(outputs.begin(), outputs.begin() + 4 * 15);
  for (const std::size_t row : {60u, 63u}) outputs[row] = std::numeric_limits<double>::quiet_NaN();
  const SobolIndices a = sobol_indices(2, outputs), b = sobol_indices(2, without);
  EXPECT_EQ(a.base_points, 15u);
  EXPECT_EQ(a.inputs[1].first, b.inputs[1].first);
  EXPECT_EQ(a.inputs[1].total_interval.high, b.inputs[1].total_interval.high);
}

TEST(SobolIndices, AreNoNumbersWhereNothingVariesOrNothingIsThere) {
  EXPECT_TRUE(std::isnan(sobol_indices(2, std::vector<double>(16, 5.0)).inputs[0].first));
  EXPECT_TRUE(std::isnan(sobol_indices(2, {}).inputs[1].total));
  EXPECT_THROW(sobol_indices(2, std::vector<double>(5)), std::invalid_argument);
}

TEST(SobolDesign, ExchangesOneInputAtATimeAndGrowsAtItsEnd) {
  const SobolDesign small = sobol_design(3, 8), large = sobol_design(3, 16);
  ASSERT_EQ(small.points.size(), 8u * 5);
  EXPECT_TRUE(std::equal(small.points.begin(), small.points.end(), large.points.begin()));
  for (std::size_t base = 0; base < small.points.size(); base += 5) {
    const Point &a = small.points[base], &b = small.points[base + 1];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(small.points[base + 2 + i][k], k == i ? b[k] : a[k]) << base << ' ' << i << ' ' << k;
  }
  EXPECT_THROW(sobol_design(0, 8), std::invalid_argument);
  EXPECT_THROW(sobol_design(21, 8), std::invalid_argument);
  EXPECT_THROW(sobol_design(3, 0), std::invalid_argument);
}

TEST(SobolDesign, FillsTheCubeEvenly) {
  const SobolDesign design = sobol_design(20, 64);
  for (std::size_t i = 0; i < 20; ++i) {
    std::vector<int> quarter(4, 0);
    for (std::size_t row = 0; row < design.points.size(); row += 22)
      ++quarter[static_cast<std::size_t>(4 * design.points[row][i])];
    for (const int count : quarter) EXPECT_NEAR(count, 16, 1) << i;
  }
}
