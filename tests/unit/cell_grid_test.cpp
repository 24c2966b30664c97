// The cell grid against trying every pair.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "libdem/core/random.h"
#include "libdem/search/cell_grid.h"
#include "libdem/search/cell_lists.h"

using dem::CellGrid;
using dem::Vec3;
using Pairs = std::multiset<std::pair<int, int>>;

namespace {

std::vector<Vec3> random_points(int count, const Vec3& size, std::uint64_t seed) {
  dem::Random random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    points.push_back(Vec3(x, y, z).cwiseProduct(size));
  }
  return points;
}

Pairs by_grid(const std::vector<Vec3>& points, double cell_size, double reach) {
  Pairs pairs;
  CellGrid(points, cell_size).for_each_pair_within(reach, [&](int i, int j) {
    EXPECT_LT(i, j);
    pairs.emplace(i, j);
  });
  return pairs;
}

Pairs by_force(const std::vector<Vec3>& points, double reach) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(points.size()); ++j)
      if ((points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).squaredNorm() <=
          reach * reach)
        pairs.emplace(i, j);
  return pairs;
}

}  // namespace

TEST(CellGrid, FindsEachPairOnceForAnyReachAndCell) {
  const auto points = random_points(700, {1, 0.5, 0.2}, 1);
  for (const double reach : {0.0, 0.03, 0.1, 0.25, 3.0})
    for (const double cell : {0.02, 0.1, 0.25, 5.0})
      EXPECT_EQ(by_grid(points, cell, reach), by_force(points, reach)) << reach << " " << cell;
}

TEST(CellGrid, FindsPairsExactlyOneReachApart) {
  std::vector<Vec3> points;
  for (int k = 0; k < 300; ++k) points.emplace_back(k * 0.1, 0, 0);
  EXPECT_EQ(by_grid(points, 0.1, 0.1), by_force(points, 0.1));
  EXPECT_EQ(by_grid(points, 0.1, 0.3), by_force(points, 0.3));
}

TEST(CellGrid, CopesWithDegenerateExtents) {
  EXPECT_TRUE(by_grid({}, 0.1, 1).empty());
  EXPECT_TRUE(by_grid({Vec3(1, 2, 3)}, 0.1, 1).empty());
  const std::vector<Vec3> same(20, Vec3(-4, 5, 6));
  EXPECT_EQ(by_grid(same, 0.1, 0).size(), 190u);
  for (const Vec3& size : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 1)}) {
    const auto points = random_points(200, size, 2);
    EXPECT_EQ(by_grid(points, 0.05, 0.05), by_force(points, 0.05));
  }
}

TEST(CellGrid, StaysSmallAndCompleteWhenPointsFlyAway) {
  auto points = random_points(2000, {1, 1, 1}, 3);
  dem::Random random(4);
  for (int k = 0; k < 30; ++k) {  // debris, in pairs so that there is something to find far away
    const Vec3 away(random.normal() * 1e4, random.normal() * 1e4, random.normal() * 1e4);
    points.push_back(away);
    points.push_back(away + Vec3(0.04, 0, 0));
  }
  points.emplace_back(1e12, -1e12, 0);
  points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  points.emplace_back(std::numeric_limits<double>::infinity(), 0, 0);
  points.emplace_back(1e300, 1e300, -1e300);
  const CellGrid grid(points, 0.1);
  EXPECT_LE(grid.cells(), 4 * points.size() + 64);
  EXPECT_LT(grid.cell_size(), 0.3);
  for (const double reach : {0.05, 0.1, 0.3}) EXPECT_EQ(by_grid(points, 0.1, reach), by_force(points, reach));
}

TEST(CellGrid, BoundsItsMemoryWhenEverythingIsFarApart) {
  const auto points = random_points(500, {1e6, 1e6, 1e6}, 5);
  const CellGrid grid(points, 1e-3);
  EXPECT_LE(grid.cells(), 4 * points.size() + 64);
  EXPECT_EQ(by_grid(points, 1e-3, 2e5), by_force(points, 2e5));
}

TEST(CellGrid, FindsWhatIsNearAPlace) {
  const auto points = random_points(500, {1, 0.5, 0.2}, 6);
  const CellGrid grid(points, 0.08);
  for (const Vec3& place :
       {Vec3(0.5, 0.2, 0.1), Vec3(-0.05, 0, 0), Vec3(1, 0.5, 0.2), Vec3(9, 9, 9), points[17]})
    for (const double reach : {0.0, 0.05, 0.08, 0.2, 20.0}) {
      std::multiset<int> found, expected;
      grid.for_each_near(place, reach, [&](int j) { found.insert(j); });
      for (std::size_t k = 0; k < points.size(); ++k)
        if ((points[k] - place).squaredNorm() <= reach * reach) expected.insert(static_cast<int>(k));
      EXPECT_EQ(found, expected);
    }
}

TEST(CellGrid, PiecesOfCellsAddUpToTheWholeInOrder) {
  const auto points = random_points(900, {1, 1, 1}, 7);
  const CellGrid grid(points, 0.1);
  std::vector<std::pair<int, int>> whole, joined;
  grid.for_each_pair_within(0.12, [&](int i, int j) { whole.emplace_back(i, j); });
  for (std::size_t c = 0; c < grid.cells(); c += 37)
    grid.for_each_pair_within(0.12, c, c + 37, [&](int i, int j) { joined.emplace_back(i, j); });
  EXPECT_EQ(whole, joined);
}

TEST(CellGrid, RefusesACellThatIsNoSize) {
  const auto points = random_points(3, {1, 1, 1}, 8);
  for (const double cell :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(CellGrid(points, cell), std::invalid_argument);
}

TEST(CellLists, FindWhatIsNearAfterAnyMoves) {
  auto points = random_points(400, {1, 0.5, 0.2}, 8);
  points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  dem::CellLists lists;
  lists.build(points, 0.1);
  dem::Random random(9);
  int found = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto i = static_cast<std::size_t>(random.below(points.size()));
    // Most stay near, some leave the box of cells, one is lost.
    const double far = n % 10 == 0 ? 3 : 0.1;
    const double x = random.uniform(-far, far), y = random.uniform(-far, far), z = random.uniform(-far, far);
    const Vec3 to =
        n == 1000 ? Vec3(0, std::numeric_limits<double>::infinity(), 0) : Vec3(points[i] + Vec3(x, y, z));
    lists.move(i, points[i], to);
    points[i] = to;
    std::multiset<int> near, all;
    lists.for_each_near(points, to, 0.15, [&](int j, double) { near.insert(j); });
    for (int j = 0; j < static_cast<int>(points.size()); ++j)
      if ((points[static_cast<std::size_t>(j)] - to).squaredNorm() <= 0.15 * 0.15) all.insert(j);
    ASSERT_EQ(near, all) << "move " << n;
    found += static_cast<int>(all.size());
  }
  EXPECT_GT(found, 5000);
  EXPECT_TRUE(lists.is_outgrown());
  lists.build(points, 0.1);
  EXPECT_FALSE(lists.is_outgrown());
}
