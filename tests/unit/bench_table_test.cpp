// The table of the benchmarks: which way a goal goes, how far the floor is, and that the files say the same.
#include "bench/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/turns.h"

using testing::HasSubstr;

namespace {

bench::Row row(double goal, bool at_most, double median, std::optional<double> floor) {
  bench::Row made;
  // Whole strings: gcc 12 warns of its own assignment of short literals (its bug 105651).
  made.part = std::string("part"), made.what = std::string("a thing"), made.unit = std::string("s");
  made.goal = goal, made.at_most = at_most, made.median = made.low = made.high = median;
  made.floor = floor;
  return made;
}

}  // namespace

TEST(BenchTable, KnowsWhichWayAGoalGoes) {
  EXPECT_TRUE(row(10, false, 10, {}).met());
  EXPECT_FALSE(row(10, false, 9.9, {}).met());
  EXPECT_TRUE(row(10, true, 10, {}).met());
  EXPECT_FALSE(row(10, true, 10.1, {}).met());
}

TEST(BenchTable, CountsTimesTheFloorFromOneUp) {
  EXPECT_DOUBLE_EQ(*row(10, false, 20, 80).ratio_to_floor(), 4)
      << "a rate: the floor is the highest there can be";
  EXPECT_DOUBLE_EQ(*row(10, true, 20, 5).ratio_to_floor(), 4) << "a time: the floor is the lowest";
  EXPECT_FALSE(row(10, true, 20, {}).ratio_to_floor());
}

TEST(BenchTable, WritesTheSameTwice) {
  bench::Machine machine;
  machine.processor = "a processor", machine.instructions = "avx2", machine.operations = 4e10;
  machine.levels = {{"memory", 600'000'000, 1.4e10, 1.2e10}};
  bench::Row long_turns = row(60, false, 66.84, 367);
  long_turns.low = 50, long_turns.high = 85, long_turns.turns = 9, long_turns.remark = "remark";
  const auto folder = std::filesystem::temp_directory_path() / "spall_bench_table_test";
  bench::write_table(folder, {long_turns, row(1, true, 2, {})}, machine);
  std::ifstream text(folder / "table.md"), numbers(folder / "table.json");
  const std::string table((std::istreambuf_iterator<char>(text)), {});
  EXPECT_EQ(table, bench::to_markdown({long_turns, row(1, true, 2, {})}, machine));
  EXPECT_THAT(
      table,
      HasSubstr("| a thing (remark) | at least 60 s | 66.8 s (50.0 to 85.0, 9 turns) | yes | 367 s | 5.49 |"));
  EXPECT_THAT(table, HasSubstr("| a thing | at most 1 s | 2.00 s | no |  |  |"));
  EXPECT_THAT(table, HasSubstr("memory 14.0 GB/s"));
  const auto json = nlohmann::json::parse(numbers);
  EXPECT_EQ(json["rows"][0]["median"], 66.84);
  EXPECT_EQ(json["rows"][1]["met"], false);
  EXPECT_EQ(json["machine"]["bytes_per_second"]["memory"]["triad"], 1.4e10);
  std::filesystem::remove_all(folder);
}

TEST(BenchTurns, MedianAndSpread) {
  const bench::Spread odd = bench::spread_of({3, 1, 2}), even = bench::spread_of({4, 1, 3, 2});
  EXPECT_EQ(odd.median, 2);
  EXPECT_EQ(even.median, 2.5);
  EXPECT_EQ(even.low, 1);
  EXPECT_EQ(even.high, 4);
  EXPECT_EQ(bench::spread_of({}).turns, 0u);
}
