// What holds of every laboratory test, whatever it measures.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "libdem/core/error.h"
#include "specimens/virtual_tests/catalogue.h"

namespace rig_checks {

using virtual_tests::TestOptions;
using virtual_tests::TestOutcome;

/// Links that neither yield nor slide.
inline dem::MaterialCard unbreakable() {
  dem::MaterialCard card;
  card.tensile_strength = 1e12;
  card.cohesion = 1e12;
  return card;
}

/// The usual card's speed, with links that do not break, to half the expected peak.
template <class Options>
TestOutcome elastic_part(const specimens::Specimen& specimen, Options options) {
  options.run.expected_strength = 3e6;
  options.run.stop_at = 1e-3;
  TestOutcome probe;
  {
    Options first = options;  // how far half the peak is
    first.run.max_control = 1e-9;
    probe = virtual_tests::run_test(specimen, unbreakable(), first);
  }
  const std::size_t row = probe.curve.rows() - 1;
  options.run.max_control = probe.curve.at(row, 0) * 1.5e6 / probe.curve.at(row, 2);
  return virtual_tests::run_test(specimen, unbreakable(), options);
}

/// The test of the default card, once for all checks.
template <class Options>
const TestOutcome& usual(const specimens::Specimen& specimen, const Options& options) {
  static std::map<std::string, TestOutcome> known;
  const std::string key = specimen.sha256() + virtual_tests::text_of(options);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, virtual_tests::run_test(specimen, {}, options)).first->second;
}

inline void expect_sound(const TestOutcome& found) {
  ASSERT_TRUE(found.run.has_value());
  EXPECT_TRUE(found.run->passed_peak);
  EXPECT_TRUE(found.run->quasi_static()) << found.run->unbalanced_force_ratio;
  EXPECT_LT(found.run->energy_balance_error, 0.005);
  EXPECT_GT(found.run->broken_links, 10u);
  const std::vector<double> broken = found.curve.column("broken");
  for (std::size_t k = 1; k < broken.size(); ++k) ASSERT_GE(broken[k], broken[k - 1]);
  for (const double value : found.curve.values) ASSERT_TRUE(std::isfinite(value));
}

template <class Options>
void expect_rate_does_not_matter(const specimens::Specimen& specimen, const Options& options) {
  const TestOutcome& at_its_speed = usual(specimen, options);
  Options short_one = options;
  short_one.run.stop_at = 0.9;
  const auto check = virtual_tests::check_rate(specimen, {}, short_one, at_its_speed);
  ASSERT_TRUE(check.has_value());
  testing::Test::RecordProperty("change", std::to_string(check->change));
  EXPECT_LT(std::abs(check->change), 0.03);
}

/// Stopped in a window, early, past the peak and at the last step but one; some way on two threads.
template <class Options>
void expect_resumes(const specimens::Specimen& specimen, Options options) {
  const TestOutcome& whole = usual(specimen, options);
  const auto folder = std::filesystem::temp_directory_path() / ("spall-rig-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const virtual_tests::CheckpointPolicy kept{.file = folder / "checkpoint.h5", .resume = true};
  const long steps = whole.run->steps;
  const long late = steps - steps / 8;
  int part = 0;
  for (const long stop : {7L, 150L, late, late + 100, steps - 1}) {
    virtual_tests::CheckpointPolicy policy = kept;
    policy.stop_after = stop;
    options.run.threads = 1 + part++ % 2;
    if (stop == late) options.run.threads = 1;
    EXPECT_THROW(virtual_tests::run_test(specimen, {}, options, {}, policy), dem::Interrupted) << stop;
  }
  options.run.threads = 1;
  const TestOutcome parts = virtual_tests::run_test(specimen, {}, options, {}, kept);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(parts.run->state_sha256, whole.run->state_sha256);
  EXPECT_EQ(parts.run->steps, steps);
  EXPECT_EQ(parts.curve.values, whole.curve.values);
  EXPECT_EQ(parts.measured, whole.measured);
  EXPECT_EQ(parts.run->energy_balance_error, whole.run->energy_balance_error);
  EXPECT_EQ(parts.run->unbalanced_force_ratio, whole.run->unbalanced_force_ratio);
}

}  // namespace rig_checks
