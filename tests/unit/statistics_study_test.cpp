// What a study's rows say together, for rows whose answer is known. The plans are those of the cases that
// reproduce the paper, so these are read here too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "libdem/core/random.h"
#include "libdem/material/micro_macro.h"
#include "study/study_statistics.h"

namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::pair<std::string, study::Value>>;

study::Plan plan_of(const std::string& name) {
  return study::make_plan(study::read_study(std::filesystem::path(SPALL_SOURCE_DIR) / "data/cases" / name));
}

/// A row for every task, its values by `values_of`.
study::RowTable table_of(const study::Plan& plan,
                         const std::function<Values(const study::Task&, const study::Row&)>& values_of) {
  study::RowTable table;
  table.tasks = plan.tasks.size();
  for (const study::Parameter& parameter : plan.study.parameters) table.parameters.push_back(parameter.key);
  for (const study::Task& task : plan.tasks) {
    const study::SpecimenRecipe& recipe = plan.specimen_of(task);
    study::Row row;
    row.task = task.number;
    row.specimen = recipe.group;
    row.seed = recipe.packing.seed;
    row.shape = "box";
    row.size = recipe.packing.size;
    row.elements = recipe.packing.elements;
    row.element_size = std::cbrt(row.size.prod() / static_cast<double>(row.elements));
    row.card = plan.study.cards[task.card].name;
    row.point = task.point + 1;
    row.parameters = plan.points[task.point].values;
    row.test = plan.test_of(task).name;
    row.kind = plan.test_of(task).kind;
    row.values = values_of(task, row);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

TEST(StudyStatistics, TableOneHasItsSixteenSamples) {
  const study::Plan plan = plan_of("study-table1.toml");
  ASSERT_EQ(plan.study.specimens.size(), 16u);
  EXPECT_EQ(plan.tasks.size(), 48u);
  for (std::size_t k = 0; k + 1 < 16; ++k) {
    const auto& packing = plan.study.specimens[k].packing;
    EXPECT_NEAR(static_cast<double>(packing.elements) / packing.size.prod(), 86400, 60) << k;
  }
  EXPECT_EQ(plan.study.specimens[14].packing.elements, 18672u);
  EXPECT_EQ(plan.study.specimens[15].packing.elements, 1427u);
}

TEST(StudyStatistics, FindAnElementSizeThatMattersAndNoSizeThatDoesNot) {
  const study::Plan plan = plan_of("study-table1.toml");
  dem::Random random(1);
  const auto rows = table_of(plan, [&](const study::Task&, const study::Row& row) -> Values {
    const double scatter = 1 + 0.01 * random.normal(), coarse = row.element_size > 0.03 ? 1.2 : 1;
    if (row.kind == study::TestKind::elastic) return {{"E", 30e9 * scatter}, {"nu", 0.2 * scatter}};
    if (row.kind == study::TestKind::tension) return {{"peak_stress", 3e6 * scatter * coarse}};
    return {{"peak_stress", 16e6 * scatter}};
  });
  const Json json = study::statistics_json(plan, rows);
  const Json &ft = json["quantities"]["ft"], &fc = json["quantities"]["fc"];
  EXPECT_EQ(ft["groups"].size(), 7u);
  EXPECT_LT(ft["effect_of_groups"]["p"].get<double>(), 1e-4);
  EXPECT_GT(fc["effect_of_groups"]["p"].get<double>(), 0.05);
  EXPECT_THAT(fc["effect_of_groups"]["words"].get<std::string>(), testing::StartsWith("No effect"));
  ASSERT_EQ(ft["factors"].size(), 2u);
  EXPECT_EQ(ft["factors"][0]["factor"], "shape and size");
  EXPECT_EQ(ft["factors"][0]["degrees"], (Json{5, 9}));
  EXPECT_GT(ft["factors"][0]["p"].get<double>(), 0.05);
  EXPECT_EQ(ft["factors"][1]["factor"], "element size");
  EXPECT_LT(ft["factors"][1]["p"].get<double>(), 1e-4);
  const Json& against = ft["against_reference"];
  EXPECT_EQ(against["reference"], "samples 1-10");
  EXPECT_EQ(against["specimens"].back()["specimen"], "sample 16");
  EXPECT_NEAR(against["specimens"].back()["deviation"].get<double>(), 0.2, 0.05);
  EXPECT_LT(against["specimens"].back()["p_holm"].get<double>(), 0.001);
  EXPECT_GT(against["specimens"].front()["p_holm"].get<double>(), 0.05);
  EXPECT_LT(ft["mean_interval"][0].get<double>(), ft["mean_interval"][1].get<double>());
  EXPECT_LT(json["card_errors"][0]["E"]["mean"].get<double>(), 0.015);
  EXPECT_EQ(json["card_errors"][0]["tests"], 16);
  EXPECT_EQ(study::statistics_json(plan, rows), json);
}

TEST(StudyStatistics, FindTheConstantsOfEqOneThatTheRowsObey) {
  const study::Plan plan = plan_of("study-kskn.toml");
  const auto rows = table_of(plan, [&](const study::Task& task, const study::Row&) -> Values {
    const dem::MaterialCard& card = plan.card_of(task);
    const auto link =
        dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
    const auto seen = dem::macro_elasticity(link, 3.9, 2.3, 3.6);
    return {{"E", seen.young_modulus}, {"nu", seen.poisson_ratio}};
  });
  const Json fit = study::statistics_json(plan, rows)["eq1"];
  EXPECT_NEAR(fit["alpha"].get<double>(), 3.9, 1e-6);
  EXPECT_NEAR(fit["beta"].get<double>(), 2.3, 1e-6);
  EXPECT_NEAR(fit["gamma"].get<double>(), 3.6, 1e-6);
  ASSERT_EQ(fit["points"].size(), 9u);
  EXPECT_NEAR(fit["points"][0]["Ks_over_Kn"].get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(fit["points"][8]["nu"].get<double>(), 0, 1e-9);
  EXPECT_EQ(fit["points"][4]["specimens"], 10);
}

TEST(StudyStatistics, FindTheSharesOfTheVariance) {
  const study::Plan plan = plan_of("study-sensitivity.toml");
  const auto rows = table_of(plan, [&](const study::Task& task, const study::Row& row) -> Values {
    const dem::MaterialCard& card = plan.card_of(task);
    if (row.kind == study::TestKind::elastic) return {{"E", card.young_modulus}, {"nu", card.poisson_ratio}};
    // In the units of their ranges T counts three times as much as zeta.
    const double T = card.tensile_strength / 3e6, zeta = std::log(card.softening) / std::log(20.0);
    return {{"peak_stress", 5 + 3 * T + zeta}};
  });
  const Json json = study::statistics_json(plan, rows)["sensitivity"];
  const Json& inputs = json["quantities"]["ft"]["inputs"];
  ASSERT_EQ(inputs.size(), 6u);
  EXPECT_EQ(inputs[0]["parameter"], "T");
  EXPECT_NEAR(inputs[0]["total"].get<double>(), 0.9, 0.15);
  EXPECT_NEAR(inputs[1]["total"].get<double>(), 0, 1e-12);
  EXPECT_NEAR(inputs[2]["total"].get<double>(), 0.1, 0.05);
  EXPECT_NEAR(json["quantities"]["nu"]["inputs"][5]["total"].get<double>(), 1, 0.15);
  EXPECT_EQ(json["quantities"]["ft"]["base_points"], 32);
}
