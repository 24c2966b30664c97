// What the interface reflects: pulses that run along a bar, against the same bar without an interface.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/coupling_pulse.h"

namespace {

using namespace coupling_scene;

/// What is reflected at 20, 10, 5 and 2 lengths, within the goals.
void expect_quiet(From from, int axis) {
  for (const auto& [lengths, goal] : pulse_goals) {
    const double part = reflected(wide_bar(), from, axis, lengths);
    EXPECT_LT(part, goal) << lengths << " finite elements long";
    testing::Test::RecordProperty("lengths_" + std::to_string(static_cast<int>(lengths)), std::to_string(part));
  }
}

}  // namespace

TEST(PressurePulse, PassesFromDiscreteElements) { expect_quiet(From::discrete, 0); }
TEST(PressurePulse, PassesFromFiniteElements) { expect_quiet(From::finite, 0); }
TEST(ShearPulse, PassesFromDiscreteElements) { expect_quiet(From::discrete, 1); }
TEST(ShearPulse, PassesFromFiniteElements) { expect_quiet(From::finite, 1); }

TEST(Interface, HasVariantsThatStayQuietAndOneThatDoesNot) {
  const auto expect_below = [](const char* name, const BarOptions& options, double goal) {
    const double part = reflected(wide_bar(), From::discrete, 0, 5, options);
    EXPECT_LT(part, goal) << name;
    testing::Test::RecordProperty(name, std::to_string(part));
  };
  BarOptions options;
  options.layers = 1;
  expect_below("one_layer", options, 0.01);
  options.layers = 5;
  expect_below("five_layers", options, 0.005);
  options = {};
  options.ties = coupling::Ties::displacements_and_rotations;
  expect_below("rotations_too", options, 0.01);
  options = {};
  options.tie.solve = coupling::MultiplierSolve::lumped;
  expect_below("lumped", options, 0.01);
  options = {};
  options.interval = 4;
  expect_below("interval_4", options, 0.01);
  options = {};
  options.weighted = false;
  EXPECT_GT(reflected(wide_bar(), From::discrete, 0, 5, options), 0.05)
      << "both domains count fully: twice the material";
}
