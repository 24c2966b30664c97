// The case data/cases/slab-small.toml in both models.
#include <gtest/gtest.h>

#include "impact/impact_run.h"
#include "impact/scene_file.h"

namespace {

/// One word switches; what else the file says stays as it is.
impact::ImpactResult struck(impact::Model model) {
  impact::Scene scene = impact::read_scene(SPALL_SOURCE_DIR "/data/cases/slab-small.toml");
  scene.frames = 0;
  if (model == impact::Model::de) scene.model = model, scene.surroundings.reset();
  return impact::run_impact(scene, 1);
}

}  // namespace

// Set at the commit that added this file, by `spall impact data/cases/slab-small.toml`.
TEST(SlabSmall, KeepsItsFigures) {
  const impact::ImpactResult found = struck(impact::Model::coupled);
  EXPECT_EQ(found.elements, 1939u);
  EXPECT_NEAR(found.peak_force, 61.14e3, 0.02 * 61.14e3);
  EXPECT_NEAR(found.residual_velocity, -2.133, 0.02 * 2.133);
  EXPECT_NEAR(found.max_displacement.at("under"), 51.4e-6, 0.03 * 51.4e-6);
  EXPECT_NEAR(found.max_displacement.at("far"), 60.4e-6, 0.03 * 60.4e-6);
  EXPECT_NEAR(static_cast<double>(found.broken_links), 6, 3);
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
