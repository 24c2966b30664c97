// Little memory ends a run with its line and exit code, whichever thread lacks it, and never hangs one.
#include <fmt/format.h>

#include "tests/cli/command.h"

namespace {

class ShortMemory : public cli::Command {
 protected:
  void SetUp() override {
    cli::Command::SetUp();
#ifdef SPALL_SANITIZED
    GTEST_SKIP() << "sanitizers want all address space";
#endif
    ASSERT_EQ(spall({"card", "example", "-o", "card.toml", "--quiet"}).code, 0);
    write("study.toml",
          "card = \"card.toml\"\ntests = [\"elastic\", \"tension\"]\n"
          "[[specimen]]\nsize = \"0.1x0.1x0.2 m\"\nelements = 200000\nseeds = [1, 2]\n");
  }
  /// With address space limited to so many kB and OpenBLAS's threads to two, on machines of many cores too;
  /// killed where a signal does not end it.
  cli::Outcome within(int kilobytes, const std::string& arguments) const {
    return shell(fmt::format("export OMP_NUM_THREADS=2; ulimit -c 0; ulimit -v {}; exec timeout -k 2 60 {} {}",
                             kilobytes, SPALL_BINARY, arguments));
  }
};

}  // namespace

TEST_F(ShortMemory, NoCommandWaitsAtItsEndForALibraryThatWantsMore) {
  // Enough to load, not for the 130 MB that each thread of OpenBLAS tries for.
  const auto run = within(250000, "card show card.toml --json");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(ShortMemory, EndsAStudyWithOneLineOnAnyNumberOfThreads) {
  for (const auto& [threads, kilobytes] : {std::pair{1, 175000}, {2, 190000}, {8, 250000}}) {
    const auto run =
        within(kilobytes, fmt::format("study run study.toml -o out --quiet --threads {}", threads));
    EXPECT_EQ(run.code, 1) << kilobytes << " kB, " << threads << " threads";
    EXPECT_THAT(run.err, testing::AnyOf(testing::StartsWith("spall: out of memory; "),
                                        testing::HasSubstr("threads can be started")));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST_F(ShortMemory, EndsAPackingWithOneLine) {
  const auto run =
      within(220000, "specimen make --size 0.1x0.1x0.2m --elements 300000 -o big.h5 --threads 2 --quiet");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "spall: out of memory; use fewer elements or a machine with more memory\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "big.h5"));
}
