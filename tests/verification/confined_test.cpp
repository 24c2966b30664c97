// Triaxial, biaxial and cyclic tests against what elasticity says of the same specimen.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "libdem/core/error.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/biaxial.h"
#include "specimens/virtual_tests/cyclic.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/membrane.h"
#include "specimens/virtual_tests/rig_run.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/triaxial.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace {

using dem::Vec3;
using specimens::Specimen;
using virtual_tests::TestOutcome;

Specimen packed(specimens::Shape shape, const Vec3& size, int elements) {
  specimens::PackingOptions packing;
  packing.shape = shape;
  packing.size = size;
  packing.elements = elements;
  packing.threads = 1;
  Specimen specimen = specimens::pack(packing);
  specimens::link(specimen, 1);
  return specimen;
}

const Specimen& prism() {
  static const Specimen made = packed(specimens::Shape::box, Vec3(0.4, 0.2, 0.2), 1400);
  return made;
}

const Specimen& cylinder() {
  static const Specimen made = packed(specimens::Shape::cylinder, Vec3(0.15, 0.15, 0.3), 1400);
  return made;
}

const Specimen& cube() {
  static const Specimen made = packed(specimens::Shape::box, Vec3(0.2, 0.2, 0.2), 1400);
  return made;
}

dem::MaterialCard unbreakable() {
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e15;
  return card;
}

template <class Options>
TestOutcome run(std::unique_ptr<virtual_tests::Rig> (*make)(const Specimen&, const dem::MaterialCard&,
                                                            const Options&),
                const Specimen& specimen, const dem::MaterialCard& card, const Options& options,
                const virtual_tests::CheckpointPolicy& checkpoint = {}) {
  const auto rig = make(specimen, card, options);
  return virtual_tests::run_rig(*rig, card, options.run, "options", {}, checkpoint);
}

}  // namespace

TEST(Membrane, PressesEvenlyAndNeitherPushesNorTurnsTheSpecimen) {
  for (const Specimen* specimen : {&prism(), &cylinder()}) {
    const int axis = specimen->long_axis(), a = (axis + 1) % 3, b = (axis + 2) % 3;
    dem::Particles particles = virtual_tests::make_assembly(*specimen, dem::MaterialCard{}).particles;
    virtual_tests::Membrane membrane(*specimen, axis);
    EXPECT_NEAR(membrane.enclosed_area(particles), specimen->section(axis), 1e-9 * specimen->section(axis));
    // The sides bulge unevenly and twist; the ends stay where they are.
    const double length = specimen->size[axis];
    for (std::size_t i = 0; i < particles.count; ++i) {
      dem::Kinematics& k = particles.kinematics[i];
      const double along = particles.initial_position[i][axis], size = specimen->element_size();
      if (along < size || along > length - size) continue;
      (&k.x)[a] += 0.004 * std::sin(40 * along + 7 * k.y);
      (&k.x)[b] += 0.003 * std::cos(31 * along);
      (&k.x)[axis] += 0.002 * std::sin(60 * along);
    }
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double pushed = 0;
    std::int32_t before = -1;
    for (const dem::ElementLoad& load : membrane.push(particles, 2e6)) {
      EXPECT_GT(load.element, before) << "sorted by element";
      before = load.element;
      force += load.force;
      moment += particles.kinematics[static_cast<std::size_t>(load.element)].position().cross(load.force) +
                load.moment;
      pushed += load.force.norm();
    }
    EXPECT_GT(pushed, 2e6 * 2 * specimen->size[a] * length);  // about the area of the sides
    EXPECT_LT(force.norm(), 1e-9 * pushed);
    EXPECT_LT(moment.norm(), 1e-3 * pushed * length);
  }
}

TEST(Triaxial, ElasticallyShowsTheSpecimensModuli) {
  const dem::MaterialCard card = unbreakable();
  for (const Specimen* specimen : {&prism(), &cylinder()}) {
    const auto elastic = virtual_tests::run_elastic(*specimen, card);
    const double bulk = elastic.young_modulus / (3 * (1 - 2 * elastic.poisson_ratio));
    virtual_tests::TriaxialOptions options;
    options.confinement = 5e6;
    options.run.expected_strength = 30e6;
    options.run.max_control = 1.2e-3 * specimen->size[specimen->long_axis()];
    const TestOutcome found = run(virtual_tests::make_triaxial_rig, *specimen, card, options);
    EXPECT_NEAR(found.value("E"), elastic.young_modulus, 0.03 * elastic.young_modulus);
    EXPECT_NEAR(found.value("nu"), elastic.poisson_ratio, 0.02);
    EXPECT_NEAR(found.value("bulk_modulus"), bulk, 0.06 * bulk);
    EXPECT_LT(found.run->energy_balance_error, 2e-3);
    EXPECT_LT(found.run->unbalanced_force_ratio, 0.05);
    EXPECT_EQ(found.run->broken_links, 0u);
  }
}

TEST(Triaxial, WithHardlyAnyPressureIsTheUniaxialTest) {
  const dem::MaterialCard card;
  virtual_tests::UniaxialOptions uniaxial;
  uniaxial.loading = virtual_tests::Loading::compression;
  uniaxial.stop_at = 0.9;
  const double strength = virtual_tests::run_uniaxial(prism(), card, uniaxial).peak_stress;
  virtual_tests::TriaxialOptions options;
  options.confinement = 1e3;
  options.run.stop_at = 0.9;
  const TestOutcome found = run(virtual_tests::make_triaxial_rig, prism(), card, options);
  EXPECT_NEAR(found.value("peak_stress"), strength, 0.02 * strength);
}

TEST(Triaxial, IsStrongerUnderMorePressure) {
  const dem::MaterialCard card;
  double last = 0;
  for (const double pressure : {1e6, 5e6}) {
    virtual_tests::TriaxialOptions options;
    options.confinement = pressure;
    options.run.max_control = 2.4e-3;
    const TestOutcome found = run(virtual_tests::make_triaxial_rig, prism(), card, options);
    EXPECT_GT(found.value("peak_stress"), last + 2 * pressure);
    EXPECT_LT(found.run->energy_balance_error, 0.01);
    last = found.value("peak_stress");
  }
}

TEST(Biaxial, ElasticallyShowsTheBiaxialModulusAndKeepsTheRatio) {
  const dem::MaterialCard card = unbreakable();
  const auto elastic = virtual_tests::run_elastic(cube(), card, {.axis = 0});
  for (const double ratio : {1.0, 0.5}) {
    virtual_tests::BiaxialOptions options;
    options.free_axis = 2;
    options.ratio = ratio;
    options.run.expected_strength = 30e6;
    options.run.max_control = 0.1e-3;
    const TestOutcome found = run(virtual_tests::make_biaxial_rig, cube(), card, options);
    const double modulus = elastic.young_modulus / (1 - elastic.poisson_ratio * ratio);
    EXPECT_NEAR(found.value("biaxial_modulus"), modulus, 0.04 * modulus) << "ratio " << ratio;
    EXPECT_NEAR(found.value("second_stress_at_peak"), ratio * found.value("peak_stress"),
                0.02 * found.value("peak_stress"));
    EXPECT_LT(found.run->energy_balance_error, 2e-3);
  }
}

TEST(Cyclic, ElasticCyclesComeBackAndDissipateNothing) {
  const dem::MaterialCard card = unbreakable();
  virtual_tests::CyclicOptions options;
  options.run.expected_strength = 30e6;
  options.run.max_control = 0.4e-3;
  options.increment = 3e-4;
  const TestOutcome found = run(virtual_tests::make_cyclic_rig, prism(), card, options);
  EXPECT_EQ(found.value("cycles"), 3);
  for (const char* cycle : {"1", "2", "3"}) {
    EXPECT_LT(std::abs(found.value(std::string("residual_strain_") + cycle)), 0.01 * 3e-4);
    EXPECT_NEAR(found.value(std::string("unloading_modulus_") + cycle), found.value("loading_modulus"),
                0.01 * found.value("loading_modulus"));
  }
  double work = 0, stored = 0;
  const virtual_tests::CurveTable& curve = found.curve;
  for (std::size_t r = 1; r < curve.rows(); ++r) {
    work += 0.5 * (curve.at(r, 2) + curve.at(r - 1, 2)) * (curve.at(r, 3) - curve.at(r - 1, 3));
    stored = 0.5 * curve.at(r, 2) * curve.at(r, 3);
  }
  EXPECT_NEAR(work, stored, 0.01 * stored) << "no hysteresis";
  EXPECT_EQ(found.run->broken_links, 0u);
}

TEST(Cyclic, EnvelopeHasThePeakOfMonotonicLoading) {
  const dem::MaterialCard card;
  for (const auto loading : {virtual_tests::Loading::compression, virtual_tests::Loading::tension}) {
    virtual_tests::UniaxialOptions monotonic;
    monotonic.loading = loading;
    const auto once = virtual_tests::run_uniaxial(prism(), card, monotonic);
    virtual_tests::CyclicOptions options;
    options.loading = loading;
    const TestOutcome found = run(virtual_tests::make_cyclic_rig, prism(), card, options);
    EXPECT_GE(found.value("cycles"), 2);
    EXPECT_NEAR(found.value("peak_stress"), once.peak_stress, 0.04 * once.peak_stress);
    EXPECT_TRUE(found.run->passed_peak);
    EXPECT_LT(found.run->energy_balance_error, 0.01);
    EXPECT_GT(found.value("residual_strain"), 0);
    EXPECT_LT(found.value("residual_strain"), found.value("unloading_strain"));
  }
}

TEST(ConfinedTests, StoppedAndGoneOnOrOnMoreThreadsGiveTheSameBits) {
  const dem::MaterialCard card;
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "confined.checkpoint.h5";
  const auto hold_for = [&](auto make, auto options, const Specimen& specimen, long stop) {
    const TestOutcome whole = run(make, specimen, card, options);
    std::filesystem::remove(file);
    EXPECT_THROW(run(make, specimen, card, options, {file, 1e9, true, stop}), dem::Interrupted);
    options.run.threads = 2;
    const TestOutcome resumed = run(make, specimen, card, options, {file, 1e9, true, 0});
    EXPECT_EQ(resumed.run->state_sha256, whole.run->state_sha256);
    EXPECT_EQ(resumed.curve.values, whole.curve.values);
    EXPECT_EQ(resumed.measured, whole.measured);
    std::filesystem::remove(file);
  };
  virtual_tests::TriaxialOptions triaxial;
  triaxial.run.max_control = 0.05e-3;
  hold_for(virtual_tests::make_triaxial_rig, triaxial, cylinder(), 500);
  virtual_tests::BiaxialOptions biaxial;
  biaxial.run.max_control = 0.05e-3;
  hold_for(virtual_tests::make_biaxial_rig, biaxial, cube(), 300);
  virtual_tests::CyclicOptions cyclic;
  cyclic.increment = 1e-4;
  cyclic.run.max_control = 0.1e-3;
  hold_for(virtual_tests::make_cyclic_rig, cyclic, prism(), 1500);
}
