// A scene and a folder for the tests of what an impact leaves.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "impact/impactors/mass_properties.h"
#include "impact/scene.h"

namespace impact_test {

namespace fs = std::filesystem;
using impact::Vec3;

/// The paper's rock above a slab of its thickness.
inline impact::Scene rock_on_slab() {
  impact::Scene scene;
  scene.title = "rock";
  scene.size = {2.5, 2.0, 0.28};
  scene.card.density = 2500;
  const impact::Shape cube = impact::make_box(Vec3(0.3, 0.3, 0.3), "test");
  impact::Impactor impactor;
  impactor.shape = cube;
  impactor.body = {impact::from_mass(cube, 67.5, "test"), {}, "test"};
  scene.impactor = impactor;
  scene.approach.aim = {1.25, 1.0, 0.28};
  scene.approach.speed = 40;
  scene.compressive_strength = 20e6;
  scene.probes = {{"centre", {1.25, 1, 0}}, {"edge, 1", {0.1, 1, 0}}};
  return scene;
}

/// An empty folder, removed at the end.
class InFolder : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / (std::string("spall-impact-") +
                                                 testing::UnitTest::GetInstance()->current_test_info()->name() +
                                                 "." + std::to_string(::getpid()));

  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
};

}  // namespace impact_test
