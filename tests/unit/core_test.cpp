// Units, random numbers, hashes and atomic files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/memory.h"
#include "libdem/core/parallel.h"
#include "libdem/core/random.h"
#include "libdem/core/sha256.h"
#include "libdem/core/units.h"
#include "tests/message_of.h"

using dem::Quantity;

TEST(Units, ConvertToSi) {
  EXPECT_DOUBLE_EQ(dem::parse_quantity("24 GPa", Quantity::stress, "t"), 24e9);
  EXPECT_DOUBLE_EQ(dem::parse_quantity("3 N/mm2", Quantity::stress, "t"), 3e6);
  EXPECT_DOUBLE_EQ(dem::parse_quantity("6 degree", Quantity::angle, "t"), 6 * M_PI / 180);
  EXPECT_DOUBLE_EQ(dem::parse_quantity("0.2", Quantity::ratio, "t"), 0.2);
  EXPECT_DOUBLE_EQ(dem::parse_quantity("2.4 permil", Quantity::ratio, "t"), 2.4e-3);
  EXPECT_THAT(dem::parse_quantities("0.5x0.25x0.25 m", Quantity::length, "t"),
              testing::ElementsAre(0.5, 0.25, 0.25));
  EXPECT_THAT(dem::parse_quantities("1.25,1.0,0.14 m", Quantity::length, "t"),
              testing::ElementsAre(1.25, 1.0, 0.14));
}

TEST(Units, RefuseWhatIsNoQuantityOfThatKind) {
  for (const char* text : {"24", "24 kg", "GPa", "nan GPa", "inf GPa", "24 wibble", "", "3 4 GPa", "24 GPa 2",
                           "3,1 GPa", "3 x 4 GPa", "1e305 GPa"})
    EXPECT_THROW(dem::parse_quantity(text, Quantity::stress, "case.toml: E"), dem::InputError) << text;
  try {
    dem::parse_quantity("24", Quantity::stress, "case.toml: E");
    FAIL();
  } catch (const dem::InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("case.toml: E"), testing::HasSubstr("24 GPa")));
  }
}

TEST(Random, GivesTheSameBitsEverywhere) {
  dem::Random random(42);
  EXPECT_EQ(random.next(), 15021278609987233951ull);  // xoshiro256++ seeded by splitmix64(42)
  dem::Random a(7), b(7);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(a.uniform(), b.uniform());
}

TEST(Random, IsUniformAndNormalInTheMean) {
  dem::Random random(1);
  double sum = 0, squares = 0;
  const int count = 200000;
  for (int k = 0; k < count; ++k) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / count, 0, 0.01);
  EXPECT_NEAR(squares / count, 1, 0.02);
}

TEST(Sha256, MatchesThePublishedValue) {
  EXPECT_EQ(dem::sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(AtomicFile, LeavesTheOldFileWhenWritingFails) {
  const auto folder = std::filesystem::temp_directory_path() / "spall-atomic-file-test";
  std::filesystem::remove_all(folder);
  dem::require_writable_folder(folder);
  const auto file = folder / "a.txt";
  dem::write_file_atomically(file, "old");
  EXPECT_THROW(
      dem::write_file_atomically(file, [](const std::filesystem::path&) { throw dem::RunError("disk full"); }),
      dem::RunError);
  std::ifstream in(file);
  std::string content;
  in >> content;
  EXPECT_EQ(content, "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(Parallel, CallsEachOnceAndThrowsWhatTheFirstThrew) {
  std::vector<int> calls(50, 0);
  dem::for_each_in_parallel(50, 3, [&](std::size_t k) { ++calls[k]; });
  EXPECT_EQ(calls, std::vector<int>(50, 1));
  calls.assign(50, 0);
  try {
    dem::for_each_in_parallel(50, 3, [&](std::size_t k) {
      ++calls[k];
      if (k % 20 == 7) throw dem::RunError(std::to_string(k));
    });
    FAIL() << "nothing was thrown";
  } catch (const dem::RunError& error) {
    EXPECT_STREQ(error.what(), "7");
  }
  EXPECT_EQ(calls, std::vector<int>(50, 1)) << "the others go on";
}

TEST(Interrupt, ARequestReachesItsOwnJobAndNoOther) {
  dem::StopRequest request{true};
  EXPECT_FALSE(dem::interrupt_requested());
  {
    const dem::StopScope scope(&request);
    EXPECT_TRUE(dem::interrupt_requested());
    bool elsewhere = true;
    std::thread([&] { elsewhere = dem::interrupt_requested(); }).join();
    EXPECT_FALSE(elsewhere) << "a thread that nobody told";
    std::vector<int> heard(20, 0);
    dem::for_each_in_parallel(20, 3, [&](std::size_t k) { heard[k] = dem::interrupt_requested() ? 1 : 0; });
    EXPECT_EQ(heard, std::vector<int>(20, 1)) << "work side by side belongs to the job";
    {
      const dem::StopScope inner(nullptr);
      EXPECT_FALSE(dem::interrupt_requested());
    }
    EXPECT_TRUE(dem::interrupt_requested());
    request = false;
    EXPECT_FALSE(dem::interrupt_requested());
    dem::set_interrupt(true);
    EXPECT_TRUE(dem::interrupt_requested()) << "a signal stops every job";
    dem::set_interrupt(false);
  }
  request = true;
  EXPECT_FALSE(dem::interrupt_requested());
}

TEST(Errors, KeepTheirParts) {
  const dem::InputError error("card.toml: nu", "is 0.4", "allowed: below 0.27");
  EXPECT_STREQ(error.what(), "card.toml: nu: is 0.4; allowed: below 0.27");
  EXPECT_EQ(error.where(), "card.toml: nu");
  EXPECT_EQ(error.what_is_wrong(), "is 0.4");
  EXPECT_EQ(error.remedy(), "allowed: below 0.27");
}

TEST(Memory, IsThereForAMegabyteAndNotForAnExabyte) {
  EXPECT_GT(dem::available_memory(), 1e6);
  EXPECT_NO_THROW(dem::require_memory(1e6, "elements", "a specimen"));
  const std::string said = test::message_of([] { dem::require_memory(1e18, "elements", "a specimen"); });
  EXPECT_THAT(said, testing::HasSubstr("elements: a specimen needs about 1e+09 GB of memory, "));
  EXPECT_THAT(said, testing::HasSubstr("GB are free; take fewer elements"));
}
