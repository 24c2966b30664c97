// Same input, same bits: on any number of threads, twice over. And the same physics on any instruction set.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "libdem/core/instructions.h"
#include "libdem/probe/damage.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/uniaxial.h"
#include "tests/verification/scene.h"

namespace {

const specimens::Specimen& cube() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.size = dem::Vec3(0.4, 0.4, 0.4);
    packing.elements = 5600;  // four blocks
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  return made;
}

/// The paper's law, or the one with moments.
dem::MaterialCard card_of(dem::LinkLawKind law) {
  dem::MaterialCard card;
  card.link_law = law;
  card.slip_softening = 3;
  card.twisting_stiffness = 0.1, card.twisting_limit = 0.2;
  return card;
}
const std::array both_laws{dem::LinkLawKind::paper, dem::LinkLawKind::moment_transfer};

virtual_tests::UniaxialResult small_tension(int threads) {
  virtual_tests::UniaxialOptions options;
  options.axis = 0;
  options.threads = threads;
  options.max_strain = 2e-4;  // past the peak
  return virtual_tests::run_uniaxial(cube(), dem::MaterialCard{}, options);
}

/// Runs this program's test of that name again on another instruction set; returns the peak that it prints.
double peak_on(const std::string& set, const std::string& test) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "SPALL_TEST_PRINTS=1 SPALL_INSTRUCTIONS=" + set + " '" + program + "' --gtest_filter=" + test;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return 0;
  std::array<char, 256> line{};
  double peak = 0;
  std::string ran;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    const std::string text(line.data());
    if (text.starts_with("peak ")) peak = std::strtod(text.c_str() + 5, nullptr);
    if (text.starts_with("set ")) ran = text.substr(4, text.size() - 5);
  }
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_EQ(ran, set);
  return peak;
}

}  // namespace

TEST(Determinism, StateAfterATensionTestIsTheSameOnAnyNumberOfThreadsAndTwice) {
  const auto once = small_tension(1);
  EXPECT_GT(once.broken_links, 50u);
  EXPECT_EQ(once.state_sha256.size(), 64u);
  for (const int threads : {1, 2, 3, 8}) {
    const auto again = small_tension(threads);
    EXPECT_EQ(again.state_sha256, once.state_sha256) << threads << " threads";
    EXPECT_EQ(again.peak_stress, once.peak_stress) << threads << " threads";
    EXPECT_EQ(again.energy.damping, once.energy.damping) << threads << " threads";
    EXPECT_EQ(again.energy.sliding, once.energy.sliding) << threads << " threads";
  }
}

TEST(Determinism, ALinkThatCrossesFromOneBlockToAnotherHasOneHistoryBitForBit) {
  for (const dem::LinkLawKind law : both_laws) {
    dem::Assembly start = virtual_tests::make_assembly(cube(), card_of(law));
    scene::shake(start.particles, 5, 4);
    std::vector<dem::BlockLoops> sets{dem::baseline_block_loops()};
#ifdef SPALL_X86
    if (dem::instructions() >= dem::Instructions::avx2) sets.push_back(dem::avx2_block_loops());
    if (dem::instructions() >= dem::Instructions::avx512) sets.push_back(dem::avx512_block_loops());
#endif
    for (const dem::BlockLoops& set : sets) {
      scene::Scene scene(start, 0.5 * scene::critical_step_of(start));
      scene.room.loops = set;
      ASSERT_EQ(scene.room.link_blocks.blocks.size(), 4u);
      ASSERT_GT(scene.room.link_blocks.crossing_links(), 1000u);
      scene.steps(200);
      EXPECT_GT(dem::broken_links(scene.assembly.law, scene.assembly.links), 50u);
      EXPECT_TRUE(scene.room.link_blocks.copies_agree());
      EXPECT_EQ(scene.assembly.links.remembers_moments, law == dem::LinkLawKind::moment_transfer);
    }
  }
}

TEST(Determinism, SumsOfEachStepAreTheSameOnAnyNumberOfThreads) {
  // A ledger hides the last bits of one step's sums in those of all steps, so these are compared step by step.
  for (const dem::LinkLawKind law : both_laws) {
    dem::Assembly start = virtual_tests::make_assembly(cube(), card_of(law));
    scene::shake(start.particles, 5, 3);
    const double dt = 0.5 * scene::critical_step_of(start);
    for (const int threads : {2, 3, 8}) {
      scene::Scene one(start, dt), many(start, dt);
      one.options.damping.factor = many.options.damping.factor = 0.3;
      many.options.threads = threads;
      for (int n = 0; n < 200; ++n) {
        const dem::StepSums expected = dem::advance(one.assembly, one.room, one.options);
        const dem::StepSums found = dem::advance(many.assembly, many.room, many.options);
        ASSERT_EQ(found.sliding, expected.sliding) << threads << " threads, step " << n;
        ASSERT_EQ(found.damped, expected.damped) << threads << " threads, step " << n;
        ASSERT_EQ(found.kinetic, expected.kinetic) << threads << " threads, step " << n;
      }
      dem::settle(one.assembly, one.room);
      dem::settle(many.assembly, many.room);
      EXPECT_EQ(dem::state_sha256(many.assembly), dem::state_sha256(one.assembly)) << threads << " threads";
      EXPECT_GT(dem::broken_links(one.assembly.law, one.assembly.links), 50u);
    }
  }
}

TEST(Determinism, InstructionSetsAgreeOnThePeakStress) {
  if (std::getenv("SPALL_TEST_PRINTS") != nullptr) {
    std::printf("set %s\npeak %.17g\n", std::string(name_of(dem::instructions())).c_str(),
                small_tension(1).peak_stress);
    return;
  }
  const std::string test = "Determinism.InstructionSetsAgreeOnThePeakStress";
  const double baseline = peak_on("baseline", test);
  ASSERT_GT(baseline, 1e6);
  for (const auto set : {dem::Instructions::avx2, dem::Instructions::avx512})
    if (set <= dem::instructions()) {
      EXPECT_NEAR(peak_on(std::string(name_of(set)), test), baseline, 1e-3 * baseline) << name_of(set);
    }
}
