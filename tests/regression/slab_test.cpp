// The case data/cases/slab-small.toml in both models.
#include <gtest/gtest.h>

#include "impact/impact_run.h"
#include "impact/scene_file.h"
#include "tests/regression/kept.h"

namespace {

/// One word switches; what else the file says stays as it is.
impact::ImpactResult struck(impact::Model model) {
  impact::Scene scene = impact::read_scene(SPALL_SOURCE_DIR "/data/cases/slab-small.toml");
  scene.frames = 0;
  if (model == impact::Model::de) scene.model = model, scene.surroundings.reset();
  return impact::run_impact(scene, 1);
}

}  // namespace

TEST(SlabSmall, KeepsItsFigures) {
  const impact::ImpactResult found = struck(impact::Model::coupled);
  const auto expect_kept = [](const char* figure, double value) {
    EXPECT_TRUE(regression::is_kept("slab-small", figure, value));
  };
  expect_kept("elements", static_cast<double>(found.elements));
  expect_kept("peak_force", found.peak_force);
  expect_kept("residual_velocity", found.residual_velocity);
  expect_kept("max_displacement_under", found.max_displacement.at("under"));
  expect_kept("max_displacement_far", found.max_displacement.at("far"));
  expect_kept("broken_links", static_cast<double>(found.broken_links));
  EXPECT_LT(found.energy_balance_error, 0.002);
}

TEST(SlabSmall, GivesMuchTheSameInBothModels) {
  const impact::ImpactResult coupled = struck(impact::Model::coupled), whole = struck(impact::Model::de);
  EXPECT_NEAR(coupled.peak_force / whole.peak_force, 1, 0.02);
  EXPECT_NEAR(coupled.residual_velocity / whole.residual_velocity, 1, 0.02);
  EXPECT_NEAR(coupled.max_displacement.at("far") / whole.max_displacement.at("far"), 1, 0.05);
  EXPECT_NEAR(coupled.max_displacement.at("under") / whole.max_displacement.at("under"), 1, 0.1);
  EXPECT_NEAR(static_cast<double>(coupled.broken_links), static_cast<double>(whole.broken_links), 3);
}
