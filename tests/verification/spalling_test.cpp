// The spalling bar: what a wave does in an elastic bar, and what a bar that breaks must show.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "libdem/core/error.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/spalling.h"

namespace {

using virtual_tests::SpallingOptions;

const specimens::Specimen& bar() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;  // 6 elements across, 60 along
    packing.size = dem::Vec3(1.0, 0.1, 0.1);
    packing.elements = 2160;
    packing.threads = 1;
    specimens::Specimen specimen = specimens::pack(packing);
    specimens::link(specimen, 1);
    return specimen;
  }();
  return made;
}

virtual_tests::TestOutcome run(const dem::MaterialCard& card, const SpallingOptions& options = {},
                               const virtual_tests::CheckpointPolicy& checkpoint = {}) {
  return virtual_tests::run_spalling(bar(), card, options, "options", {}, checkpoint);
}

dem::MaterialCard unbreakable() {
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e15;
  return card;
}

double highest(const virtual_tests::CurveTable& curve, const char* column, double sign = 1) {
  double found = 0;
  for (const double value : curve.column(column)) found = std::max(found, sign * value);
  return found;
}

}  // namespace

TEST(Spalling, InAnElasticBarFollowsWaveTheory) {
  const dem::MaterialCard card = unbreakable();
  SpallingOptions options;
  options.incident_stress = 5e6;
  const auto found = run(card, options);
  const double modulus = virtual_tests::run_elastic(bar(), card).young_modulus;
  const double speed = std::sqrt(modulus / card.density);
  EXPECT_NEAR(found.value("wave_speed"), speed, 0.02 * speed);
  EXPECT_NEAR(found.value("free_end_velocity"), 2 * found.value("incident_velocity"),
              0.03 * found.value("free_end_velocity"))
      << "a free end moves twice as fast as the wave";
  EXPECT_NEAR(found.value("incident_velocity"), found.run->velocity, 0.03 * found.run->velocity);
  EXPECT_NEAR(found.value("incident_stress"), 5e6, 0.05 * 5e6);
  EXPECT_NEAR(found.value("reflected_stress"), found.value("incident_stress"),
              0.08 * found.value("incident_stress"))
      << "compression comes back as tension";
  EXPECT_NEAR(highest(found.curve, "gauge_strain", -1) * modulus, found.value("incident_stress"), 0.05 * 5e6);
  // Across the section of the highest tension: as much again, by the momentum beyond it.
  EXPECT_NEAR(found.value("fracture_stress"), found.value("incident_stress"), 0.12 * 5e6);
  EXPECT_FALSE(found.run->passed_peak);
  EXPECT_EQ(found.value("spall_strength"), 0);
  EXPECT_EQ(found.run->broken_links, 0u);
  EXPECT_LT(found.run->energy_balance_error, 1e-3);
}

TEST(Spalling, BreaksTheBarInsideHalfAWavelengthAndKeepsTheLedger) {
  dem::MaterialCard card;
  SpallingOptions options;
  options.static_strength = 2.5e6;
  const auto found = run(card, options);
  EXPECT_TRUE(found.run->passed_peak);
  EXPECT_GT(found.value("fracture_damage"), 0.3);
  EXPECT_LT(found.value("fracture_position"), 0.5 * 0.4 + 0.05);
  EXPECT_GT(found.value("fracture_position"), 0.03);
  // Novikov's strength takes the section to break at once; the momentum beyond it knows what it bore.
  EXPECT_GT(found.value("fracture_stress"), 0.8 * card.tensile_strength);
  EXPECT_GT(found.value("spall_strength"), found.value("fracture_stress"));
  EXPECT_LT(found.value("spall_strength"), 1.6 * found.value("fracture_stress"));
  // From a tenth to nine tenths of what it bore in some 10 microseconds.
  EXPECT_GT(found.value("strain_rate"), 1);
  EXPECT_LT(found.value("strain_rate"), 100);
  EXPECT_GT(found.value("spall_strength"), 0.8 * card.tensile_strength);
  EXPECT_LT(found.value("spall_strength"), found.value("incident_stress"));
  EXPECT_DOUBLE_EQ(found.value("dynamic_increase_factor"), found.value("spall_strength") / 2.5e6);
  EXPECT_LT(found.run->energy_balance_error, 2e-3);
}

TEST(Spalling, HardlyDependsOnItsTimeStep) {
  const dem::MaterialCard card;
  SpallingOptions options;
  const auto found = run(card, options);
  options.time_step_fraction = 0.35;
  const auto finer = run(card, options);
  EXPECT_NEAR(finer.value("spall_strength"), found.value("spall_strength"),
              0.05 * found.value("spall_strength"));
}

TEST(Spalling, StoppedAndGoneOnOrOnMoreThreadsGivesTheSameBits) {
  const dem::MaterialCard card;
  SpallingOptions options;
  const auto whole = run(card, options);
  options.threads = 2;
  EXPECT_EQ(run(card, options).run->state_sha256, whole.run->state_sha256);
  options.threads = 1;
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "spalling.checkpoint.h5";
  std::filesystem::remove(file);
  for (const long stop : {20L, 150L}) {  // during the pulse, and after it
    virtual_tests::CheckpointPolicy policy{file, 1e9, true, stop};
    EXPECT_THROW(run(card, options, policy), dem::Interrupted);
  }
  const auto resumed = run(card, options, {file, 1e9, true, 0});
  EXPECT_EQ(resumed.run->state_sha256, whole.run->state_sha256);
  EXPECT_EQ(resumed.curve.values, whole.curve.values);
  EXPECT_EQ(resumed.measured, whole.measured);
  EXPECT_EQ(resumed.run->energy_balance_error, whole.run->energy_balance_error);
  std::filesystem::remove(file);
}

TEST(Spalling, RefusesAPulseThatDoesNotSuitTheBar) {
  SpallingOptions options;
  options.duration = 1e-2;
  EXPECT_THROW(virtual_tests::check_spalling(bar(), dem::MaterialCard{}, options), dem::InputError);
  options.duration = 1e-6;
  EXPECT_THROW(virtual_tests::check_spalling(bar(), dem::MaterialCard{}, options), dem::InputError);
  options.duration = 0;
  options.axis = 1;
  EXPECT_THROW(virtual_tests::check_spalling(bar(), dem::MaterialCard{}, options), dem::InputError);
}
