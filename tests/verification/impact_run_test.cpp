// Whole impacts on small slabs: what must hold whatever breaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "impact/impact_run.h"
#include "impact/model.h"
#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "tests/scenes/impact_slab.h"

namespace {

using namespace impact;
using namespace impact_scene;

class ImpactRun : public testing::TestWithParam<Model> {};

INSTANTIATE_TEST_SUITE_P(Models, ImpactRun, testing::Values(Model::de, Model::coupled),
                         [](const auto& of) { return of.param == Model::de ? "de" : "coupled"; });

}  // namespace

TEST_P(ImpactRun, KeepsEnergyAndMomentumWhileLinksBreak) {
  const ImpactResult result = run_impact(slab(GetParam(), brittle, 8), 1);
  EXPECT_GT(result.broken_links, 50u);
  EXPECT_GT(result.energy.softening, 0.01 * result.energy.initial);
  EXPECT_LT(result.energy_balance_error, 0.005);
  EXPECT_LT(result.momentum_error, 1e-6);
  // The impactor has lost what the structure and its supports have taken.
  EXPECT_NEAR(result.impulse.z(), 2500 * 0.06 * 0.06 * 0.06 * (8 - result.residual_velocity),
              1e-9 * result.impulse.z());
}

TEST_P(ImpactRun, KeepsEnergyToAMilliPercentWhereNothingBreaks) {
  const ImpactResult result = run_impact(slab(GetParam(), unbreakable, 1), 1);
  EXPECT_EQ(result.broken_links, 0u);
  EXPECT_EQ(result.energy.softening, 0);
  EXPECT_LT(result.energy_balance_error, 5e-4);
  EXPECT_TRUE(result.fragments.fragments.size() == 1);
}

TEST(CoupledImpact, KeepsItsLedgerClosedWhenFiniteElementsStepSeldom) {
  Scene scene = slab(Model::coupled, unbreakable, 1);
  scene.surroundings->interval = 0;  // as seldom as is stable
  const ImpactResult result = run_impact(scene, 1);
  EXPECT_LT(result.energy_balance_error, 2e-3);
  RecordProperty("imbalance", std::to_string(result.energy_balance_error));
}

TEST_P(ImpactRun, NotesDownTheStart) {
  Scene scene = slab(GetParam(), unbreakable, 1);
  scene.duration = 1e-9;
  const ImpactResult result = run_impact(scene, 1);
  EXPECT_EQ(result.history.size(), static_cast<std::size_t>(result.steps) + 1)
      << "a row for each of the few steps";
  const Sample& first = result.history.front();
  EXPECT_EQ(first.time, 0);
  EXPECT_EQ(first.displacement, std::vector<Vec3>(2, Vec3::Zero()));
  EXPECT_EQ(first.force, Vec3::Zero());
  EXPECT_EQ(first.impactor_velocity, Vec3(0, 0, -1));
  EXPECT_EQ(first.energy.final_sum(), result.energy.initial);
}

TEST_P(ImpactRun, GivesTheSameBitsOnAnyNumberOfThreads) {
  const ImpactResult one = run_impact(slab(GetParam(), brittle, 8), 1);
  for (const int threads : {2, 3, 8}) {
    const ImpactResult many = run_impact(slab(GetParam(), brittle, 8), threads);
    EXPECT_EQ(many.state_sha256, one.state_sha256) << threads << " threads";
    EXPECT_EQ(many.impulse.z(), one.impulse.z()) << threads << " threads";
    EXPECT_EQ(many.energy.final_sum(), one.energy.final_sum()) << threads << " threads";
  }
}

TEST_P(ImpactRun, GoesOnFromACheckpointWithTheSameBits) {
  const Scene scene = slab(GetParam(), brittle, 8);
  const ImpactResult whole = run_impact(scene, 1);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("impact_") + (GetParam() == Model::de ? "de" : "coupled") + ".h5");
  std::filesystem::remove(file);
  // A signal in the middle of the run.
  const auto stop_half_way = [&](const dem::Progress& progress) {
    if (progress.stage == "impact" && progress.done > 0.4 * progress.total) dem::set_interrupt(true);
  };
  Scene stopped = scene;
  stopped.sample_interval = 0;
  EXPECT_THROW(run_impact(stopped, 1, stop_half_way, {}, {.file = file}), dem::Interrupted);
  dem::set_interrupt(false);
  const ImpactResult resumed = run_impact(scene, 2, {}, {}, {.file = file, .resume = true});
  EXPECT_EQ(resumed.state_sha256, whole.state_sha256);
  EXPECT_EQ(resumed.steps, whole.steps);
  EXPECT_EQ(resumed.energy.final_sum(), whole.energy.final_sum());
  ASSERT_EQ(resumed.history.size(), whole.history.size());
  for (std::size_t k = 0; k < whole.history.size(); ++k) {
    EXPECT_EQ(resumed.history[k].displacement, whole.history[k].displacement) << k;
    EXPECT_EQ(resumed.history[k].force, whole.history[k].force) << k;
    EXPECT_EQ(resumed.history[k].energy.final_sum(), whole.history[k].energy.final_sum()) << k;
  }
  std::filesystem::remove(file);
}

TEST(ImpactModels, AgreeOnAnElasticSlab) {
  const ImpactResult discrete = run_impact(slab(Model::de, unbreakable, 1), 1);
  const ImpactResult coupled = run_impact(slab(Model::coupled, unbreakable, 1), 1);
  const double expected = discrete.max_displacement.at("aside");
  EXPECT_NEAR(coupled.max_displacement.at("aside"), expected, 0.1 * expected);
  EXPECT_NEAR(coupled.impulse.z(), discrete.impulse.z(), 0.02 * discrete.impulse.z());
}

TEST(ImpactModels, HaveTheSameElementsWhereTheZoneIsCutFromTheWhole) {
  const ImpactModel whole = make_model(slab(Model::de, brittle, 1), 1, {});
  Scene scene = slab(Model::coupled, brittle, 1);
  scene.surroundings->cut_from_whole = true;
  scene.structure.packing = slab(Model::de, brittle, 1).structure.packing;
  const ImpactModel cut = make_model(scene, 1, {});
  const Surroundings& around = *scene.surroundings;
  std::vector<Vec3> wanted;
  for (const Vec3& at : whole.assembly.particles.initial_position)
    if ((at.array() >= around.zone_low.array()).all() && (at.array() <= around.zone_high.array()).all())
      wanted.push_back(at);
  ASSERT_EQ(cut.assembly.particles.count, wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_LT((cut.assembly.particles.initial_position[i] - wanted[i]).norm(), 1e-14);
}

TEST(ImpactScene, ThatDoesNotFitTogetherIsRefused) {
  const auto refused = [](const Scene& scene) -> std::string {
    try {
      run_impact(scene, 2);
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  Scene nothing_held = slab(Model::de, brittle, 8);
  nothing_held.supports[0].low = nothing_held.supports[0].high = Vec3(-1, -1, -1);
  EXPECT_EQ(refused(nothing_held).find("support \"left\": holds nothing"), 0u) << refused(nothing_held);
  Scene missed = slab(Model::de, brittle, 8);
  missed.approach.aim = Vec3(2, 2, 0);
  EXPECT_EQ(refused(missed).find("impactor: its path never meets"), 0u) << refused(missed);
  Scene hurried = slab(Model::coupled, brittle, 8);
  hurried.surroundings->interval = 50;
  EXPECT_EQ(refused(hurried).find("coupling.interval: 50 steps"), 0u) << refused(hurried);
}
