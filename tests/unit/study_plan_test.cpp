// The plan of a study: its design, its tasks and what their names depend on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <string>

#include "libdem/material/micro_macro.h"
#include "study/estimate.h"
#include "study/plan.h"
#include "study/plan_key.h"
#include "tests/message_of.h"

using testing::ElementsAre;
using testing::HasSubstr;

namespace {

study::SpecimenRecipe recipe(std::uint64_t seed, std::size_t elements = 2700) {
  study::SpecimenRecipe made;
  made.group = "box";
  made.packing.size = {0.5, 0.25, 0.25};
  made.packing.elements = elements;
  made.packing.seed = seed;
  return made;
}

study::VirtualTest virtual_test(study::TestKind kind) {
  study::VirtualTest test;
  test.name = std::string(study::name_of(kind));
  test.kind = kind;
  test.options = virtual_tests::description_of(kind).defaults;
  return test;
}

study::Study small_study() {
  study::Study study;
  study.file = "study.toml";
  study.cards.push_back({"card", "card.toml", {}});
  study.specimens = {recipe(1), recipe(2)};
  study.tests = {virtual_test(study::TestKind::elastic), virtual_test(study::TestKind::tension),
                 virtual_test(study::TestKind::compression)};
  return study;
}

study::Parameter listed(const std::string& key, std::vector<double> values) {
  study::Parameter parameter;
  parameter.key = key;
  parameter.values = std::move(values);
  return parameter;
}

study::Parameter ranged(const std::string& key, double from, double to, bool logarithmic = false) {
  study::Parameter parameter;
  parameter.key = key;
  parameter.from = from, parameter.to = to, parameter.logarithmic = logarithmic;
  return parameter;
}

}  // namespace

TEST(StudyDesign, FactorialHasEveryCombinationOnce) {
  study::Study study = small_study();
  EXPECT_EQ(study::design_points(study).size(), 1u);
  study.parameters = {listed("T", {1, 2, 3}), listed("zeta", {5, 10})};
  const auto points = study::design_points(study);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_THAT(points[1].values, ElementsAre(1, 10));
  EXPECT_THAT(points[2].values, ElementsAre(2, 5));
  study.parameters = {listed("T", std::vector<double>(2000, 1.0)),
                      listed("zeta", std::vector<double>(2000, 1.0))};
  EXPECT_THAT(test::message_of([&] { study::design_points(study); }), HasSubstr("at most a million"));
}

TEST(StudyDesign, SobolPointsFillTheRangesEvenly) {
  study::Study study = small_study();
  study.design = study::DesignKind::sobol;
  study.points = 63;  // with the origin, which the sequence leaves out, a whole power of two
  study.parameters = {ranged("T", 2e6, 4e6), ranged("zeta", 1, 100, true)};
  const auto points = study::design_points(study);
  ASSERT_EQ(points.size(), 63u);
  EXPECT_THAT(points[0].values, ElementsAre(3e6, testing::DoubleNear(10, 1e-12)));
  // Each of eight strips of a range holds eight points, or seven where the origin is missing.
  std::vector<int> first(8), second(8);
  for (const study::DesignPoint& point : points) {
    ++first[static_cast<std::size_t>(8 * (point.values[0] - 2e6) / 2e6)];
    ++second[static_cast<std::size_t>(8 * std::log10(point.values[1]) / 2 + 1e-9)];
  }
  EXPECT_THAT(first, ElementsAre(7, 8, 8, 8, 8, 8, 8, 8));
  EXPECT_THAT(second, ElementsAre(7, 8, 8, 8, 8, 8, 8, 8));
}

TEST(StudyDesign, SensitivitySwapsOneColumnAtATime) {
  study::Study study = small_study();
  study.design = study::DesignKind::sobol;
  study.points = 16;
  study.sensitivity = true;
  study.parameters = {ranged("T", 0, 1), ranged("zeta", 0, 1), ranged("Co", 0, 1)};
  const auto points = study::design_points(study);
  ASSERT_EQ(points.size(), 16u * 5);
  for (std::size_t row = 0; row < 16; ++row) {
    const study::DesignPoint *a = &points[5 * row], *b = a + 1;
    EXPECT_EQ(a->block, "A");
    EXPECT_EQ(b->block, "B");
    for (std::size_t p = 0; p < 3; ++p) {
      const study::DesignPoint& mixed = a[2 + p];
      EXPECT_EQ(mixed.block, "AB" + std::to_string(p + 1));
      EXPECT_EQ(mixed.base, row);
      for (std::size_t q = 0; q < 3; ++q) EXPECT_EQ(mixed.values[q], (q == p ? b : a)->values[q]);
    }
  }
  EXPECT_NE(points[5].values, points[6].values);
}

TEST(StudyPlan, NumbersEveryTestOnEverySpecimenAtEverySetting) {
  study::Study study = small_study();
  study.parameters = {listed("T", {2e6, 3e6})};
  const study::Plan plan = study::make_plan(study);
  ASSERT_EQ(plan.tasks.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(plan.tasks[k].number, k + 1);
  EXPECT_EQ(plan.tasks[5].specimen, 0u);
  EXPECT_EQ(plan.tasks[6].specimen, 1u);
  EXPECT_EQ(plan.card_of(plan.tasks[3]).tensile_strength, 3e6);
  EXPECT_EQ(plan.test_of(plan.tasks[4]).kind, study::TestKind::tension);
  // T does not enter the elastic test: two specimens, one result each.
  std::set<std::string> keys;
  for (const study::Task& task : plan.tasks) keys.insert(task.key);
  EXPECT_EQ(keys.size(), 10u);
  EXPECT_EQ(plan.tasks[0].key, plan.tasks[3].key);
}

TEST(StudyPlan, ATestThatNamesSpecimensGoesThroughThoseOnly) {
  const auto file =
      std::filesystem::temp_directory_path() / ("spall-groups." + std::to_string(::getpid()) + ".toml");
  const std::string card = (std::filesystem::path(SPALL_SOURCE_DIR) / "data/cards/table1.toml").string();
  const auto plan_with = [&](const std::string& specimens) {
    std::ofstream(file)
        << "card = \"" << card << "\"\n"
        << "[[specimen]]\nname = \"prism\"\nsize = \"0.4x0.2x0.2 m\"\nelements = 1400\nseeds = \"1-3\"\n"
        << "[[specimen]]\nname = \"cube\"\nsize = \"0.25x0.25x0.25 m\"\nelements = 1350\nseeds = \"1-2\"\n"
        << "[[test]]\nkind = \"elastic\"\n[[test]]\nkind = \"tension\"\nspecimens = " << specimens << "\n";
    study::Plan plan = study::make_plan(study::read_study(file));
    std::filesystem::remove(file);
    return plan;
  };
  const study::Plan plan = plan_with("\"cube\"");
  ASSERT_EQ(plan.tasks.size(), 7u);
  for (const study::Task& task : plan.tasks)
    if (task.test == 1) {
      EXPECT_EQ(plan.study.specimens[task.specimen].group, "cube");
    }
  EXPECT_EQ(plan_with("[\"cube\", \"prism\"]").tasks.size(), 10u);
  try {
    plan_with("\"kube\"");
    FAIL() << "accepted";
  } catch (const dem::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"cube\""), std::string::npos) << error.what();
  }
  std::filesystem::remove(file);
}

TEST(StudyPlan, StiffnessRatioKeepsTheNormalStiffness) {
  study::Study study = small_study();
  study.parameters = {listed(study::stiffness_ratio_key, {0.1, 0.5, 1.0})};
  const study::Plan plan = study::make_plan(study);
  const dem::MaterialCard base;
  const double modulus =
      dem::link_stiffness(base.young_modulus, base.poisson_ratio, base.alpha, base.beta, base.gamma)
          .normal_modulus;
  ASSERT_EQ(plan.cards.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const dem::MaterialCard& card = plan.cards[k];
    const dem::LinkStiffness link =
        dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
    EXPECT_NEAR(link.normal_modulus / modulus, 1, 1e-14);
    EXPECT_NEAR(link.shear_ratio, study.parameters[0].values[k], 1e-14);
  }
  EXPECT_NEAR(plan.cards[2].poisson_ratio, 0, 1e-15);
}

TEST(StudyPlan, RefusesSettingsThatMakeNoCard) {
  study::Study study = small_study();
  study.parameters = {listed("nu", {0.1, 0.3})};
  EXPECT_THAT(test::message_of([&] { study::make_plan(study); }),
              testing::AllOf(HasSubstr("study.toml: vary, at nu = 0.3 of card card"), HasSubstr("1/alpha")));
  study.parameters = {listed("T", {-1})};
  EXPECT_THAT(test::message_of([&] { study::make_plan(study); }), HasSubstr("T"));
}

TEST(StudyPlan, AResultsNameHasAllThatItDependsOnAndNothingElse) {
  const dem::MaterialCard card;
  const study::VirtualTest tension = virtual_test(study::TestKind::tension);
  const std::string key = study::task_key(recipe(1), card, tension);
  EXPECT_EQ(key.size(), 64u);
  std::set<std::string> others{key};
  const auto differs = [&](const study::SpecimenRecipe& r, const dem::MaterialCard& c,
                           const study::VirtualTest& t) {
    return others.insert(study::task_key(r, c, t)).second;
  };
  EXPECT_TRUE(differs(recipe(2), card, tension));
  EXPECT_TRUE(differs(recipe(1, 2701), card, tension));
  auto other = recipe(1);
  other.packing.size.x() += 1e-9;
  EXPECT_TRUE(differs(other, card, tension));
  other = recipe(1);
  other.packing.solid_fraction = 0.41;
  EXPECT_TRUE(differs(other, card, tension));
  other = recipe(1);
  other.file = "s1.h5", other.sha256 = "abc";
  EXPECT_TRUE(differs(other, card, tension));
  for (const dem::CardNumber& number : dem::numbers_of(card)) {
    study::Study study = small_study();
    study.specimens = {recipe(1)}, study.tests = {tension};
    study.parameters = {listed(std::string(number.key), {number.value * 1.01})};
    EXPECT_TRUE(others.insert(study::make_plan(study).tasks[0].key).second) << number.key;
  }
  dem::MaterialCard chosen;
  chosen.unloading = dem::SofteningUnloading::elastic;
  EXPECT_TRUE(differs(recipe(1), chosen, tension));
  EXPECT_TRUE(differs(recipe(1), card, virtual_test(study::TestKind::compression)));
  EXPECT_TRUE(differs(recipe(1), card, virtual_test(study::TestKind::elastic)));
  for (double virtual_tests::UniaxialOptions::*number :
       {&virtual_tests::UniaxialOptions::velocity, &virtual_tests::UniaxialOptions::rate,
        &virtual_tests::UniaxialOptions::damping, &virtual_tests::UniaxialOptions::stop_at,
        &virtual_tests::UniaxialOptions::max_strain, &virtual_tests::UniaxialOptions::expected_strength,
        &virtual_tests::UniaxialOptions::time_step_fraction}) {
    study::VirtualTest test = tension;
    std::get<virtual_tests::UniaxialOptions>(test.options).*number += 0.01;
    EXPECT_TRUE(differs(recipe(1), card, test));
  }
  study::VirtualTest test = tension;
  std::get<virtual_tests::UniaxialOptions>(test.options).ends = dem::EndCondition::fixed;
  EXPECT_TRUE(differs(recipe(1), card, test));

  test = tension;
  test.name = "another";
  virtual_tests::set_threads(test.options, 7);
  auto renamed = recipe(1);
  renamed.group = "another", renamed.packing.threads = 3;
  dem::MaterialCard named;
  named.name = "another";
  EXPECT_EQ(study::task_key(renamed, named, test), key);
}

TEST(StudyPlan, SharesPartTheTasksEvenly) {
  study::Study study = small_study();
  study.specimens.push_back(recipe(3, 10000));
  const study::Plan plan = study::make_plan(study);
  const auto all = study::choose_tasks(plan, "", "");
  std::vector<std::size_t> together;
  double longest = 0, shortest = 1e300;
  for (std::size_t share = 0; share < 2; ++share) {
    const auto own = study::share_of(plan, all, share, 2);
    double seconds = 0;
    for (const std::size_t task : own) seconds += plan.tasks[task].seconds;
    longest = std::max(longest, seconds), shortest = std::min(shortest, seconds);
    together.insert(together.end(), own.begin(), own.end());
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, all);
  EXPECT_LE(longest - shortest, plan.tasks[8].seconds);
  EXPECT_THAT(study::choose_tasks(plan, "2-3, 9", "--tasks"), ElementsAre(1, 2, 8));
  EXPECT_THAT(test::message_of([&] { study::choose_tasks(plan, "10", "--tasks"); }),
              HasSubstr("allowed: 1 to 9"));
}

TEST(StudyEstimate, GrowsWithTheWork) {
  const dem::MaterialCard card;
  const auto seconds = [&](const study::SpecimenRecipe& r, study::VirtualTest test) {
    return study::estimate_test(r.packing, card, test).seconds;
  };
  study::VirtualTest compression = virtual_test(study::TestKind::compression);
  const double base = seconds(recipe(1), compression);
  EXPECT_GT(base, seconds(recipe(1), virtual_test(study::TestKind::elastic)));
  // Twice the elements along each side: eight times the elements, twice the steps.
  EXPECT_NEAR(seconds(recipe(1, 8 * 2700), compression) / base, 16, 0.1);
  std::get<virtual_tests::UniaxialOptions>(compression.options).rate = 0.005;
  EXPECT_NEAR(seconds(recipe(1), compression) / base, 2, 1e-12);
}
