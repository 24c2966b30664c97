// A test that is stopped and goes on gives the same bits as one that is not; a checkpoint that does not fit is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/io/hdf5.h"
#include "libdem/run/checkpoint.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/expected_end.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/uniaxial.h"
#include "tests/verification/scene.h"

using testing::AllOf;
using testing::HasSubstr;
using virtual_tests::CheckpointPolicy;
using virtual_tests::Loading;
using virtual_tests::UniaxialOptions;
using virtual_tests::UniaxialResult;

namespace {

const specimens::Specimen& small_block(std::uint64_t seed = 1) {
  const auto make = [](std::uint64_t number) {
    specimens::PackingOptions packing;
    packing.size = dem::Vec3(0.3, 0.2, 0.2);
    packing.elements = 900;
    packing.threads = 1;
    packing.seed = number;
    return specimens::make_specimen(packing);
  };
  static const specimens::Specimen first = make(1), second = make(2);
  return seed == 1 ? first : second;
}

UniaxialOptions options_for(Loading loading) {
  UniaxialOptions options;
  options.loading = loading;
  // A crush, fast and far: links break, and elements that were never linked meet.
  if (loading == Loading::compression) options.stop_at = 1e-6, options.max_strain = 0.2, options.velocity = 10;
  return options;
}

class Resume : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      (std::string("spall-resume-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "." +
       std::to_string(::getpid()));
  std::filesystem::path file = folder / "checkpoint.h5";
  dem::MaterialCard card;

  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override {
    dem::set_interrupt(false);
    std::filesystem::remove_all(folder);
  }

  UniaxialResult run(const UniaxialOptions& options, const CheckpointPolicy& policy = {}) const {
    return run_uniaxial(small_block(), card, options, {}, policy);
  }
  /// Runs to `step` of the test, from the checkpoint if it is there; leaves a checkpoint.
  void run_to(long step, const UniaxialOptions& options) const {
    EXPECT_THROW(run(options, {.file = file, .resume = true, .stop_after = step}), dem::Interrupted) << step;
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  UniaxialResult go_on(const UniaxialOptions& options) const {
    return run(options, {.file = file, .resume = true});
  }
  std::string refusal(const UniaxialOptions& options, const specimens::Specimen& specimen,
                      const dem::MaterialCard& other) const {
    try {
      run_uniaxial(specimen, other, options, {}, {.file = file, .resume = true});
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "accepted";
  }
};

void expect_same_bits(const UniaxialResult& found, const UniaxialResult& whole) {
  EXPECT_EQ(found.state_sha256, whole.state_sha256);
  EXPECT_EQ(found.steps, whole.steps);
  ASSERT_EQ(found.curve.size(), whole.curve.size());
  for (std::size_t k = 0; k < whole.curve.size(); ++k) {
    const virtual_tests::CurvePoint &a = found.curve[k], &b = whole.curve[k];
    ASSERT_TRUE(a.strain == b.strain && a.stress == b.stress && a.strain_axial == b.strain_axial &&
                a.strain_lateral == b.strain_lateral && a.broken == b.broken && a.unbalanced == b.unbalanced)
        << "point " << k;
  }
  const dem::EnergyLedger &e = found.energy, &f = whole.energy;
  EXPECT_TRUE(e.external == f.external && e.initial == f.initial && e.kinetic == f.kinetic &&
              e.elastic == f.elastic && e.softening == f.softening && e.sliding == f.sliding &&
              e.damping == f.damping);
  EXPECT_EQ(found.energy_balance_error, whole.energy_balance_error);
  EXPECT_EQ(found.peak_stress, whole.peak_stress);
  EXPECT_EQ(found.peak_strain, whole.peak_strain);
  EXPECT_EQ(found.broken_links, whole.broken_links);
  EXPECT_EQ(found.contacts, whole.contacts);
  EXPECT_EQ(found.damage, whole.damage);
  EXPECT_EQ(found.link_strain, whole.link_strain);
  EXPECT_EQ(found.detector_rebuilds, whole.detector_rebuilds);
}

}  // namespace

TEST_F(Resume, TensionStoppedAtAnyStepGivesTheSameBits) {
  const UniaxialOptions options = options_for(Loading::tension);
  const UniaxialResult whole = run(options);
  ASSERT_TRUE(whole.passed_peak);
  ASSERT_GT(whole.broken_links, 20u);
  // The first step, the middle of a window, before the peak and past it, and the last step but one.
  for (const long step : {1L, 7L, whole.steps / 3, whole.steps - whole.steps / 8, whole.steps - 1}) {
    SCOPED_TRACE("stopped after step " + std::to_string(step));
    std::filesystem::remove(file);
    run_to(step, options);
    expect_same_bits(go_on(options), whole);
  }
}

TEST_F(Resume, AfterLinksBrokeAndContactsFormedManyStopsOnAnyThreadsGiveTheSameBits) {
  for (const dem::LinkLawKind law : {dem::LinkLawKind::paper, dem::LinkLawKind::moment_transfer}) {
    card.link_law = law;
    std::filesystem::remove(file);
    UniaxialOptions options = options_for(Loading::compression);
    options.ends = law == dem::LinkLawKind::paper ? dem::EndCondition::fixed : dem::EndCondition::rough;
    const UniaxialResult whole = run(options);
    RecordProperty("steps", std::to_string(whole.steps));
    RecordProperty("contacts", std::to_string(whole.contacts));
    ASSERT_GT(whole.broken_links, 500u);
    ASSERT_GT(whole.contacts, 0u) << "raise the strain";
    ASSERT_GT(whole.detector_rebuilds, 3);
    for (const long part : {1L, 2L, 3L, 4L}) {
      options.threads = part % 2 == 0 ? 2 : 1;
      run_to(whole.steps * part / 5 + part, options);
    }
    options.threads = 2;
    run_to(whole.steps - 3, options);
    EXPECT_GT(dem::Hdf5File::open(file).read<std::uint64_t>("contacts/count")[0], 0u);
    options.threads = 1;
    expect_same_bits(go_on(options), whole);
  }
}

TEST_F(Resume, ASignalStopsAfterTheStepAndACheckpointIsWrittenNowAndThen) {
  const UniaxialOptions options = options_for(Loading::tension);
  const UniaxialResult whole = run(options);
  int points = 0;
  const auto signal = [&](const dem::Progress&) { dem::set_interrupt(++points == 10); };
  try {
    run_uniaxial(small_block(), card, options, signal, {.file = file});
    FAIL() << "ran on";
  } catch (const dem::Interrupted& stop) {
    EXPECT_THAT(stop.what(), HasSubstr("stopped by a signal at step"));
  }
  EXPECT_EQ(points, 10);
  dem::set_interrupt(false);
  expect_same_bits(go_on(options), whole);
  // No signal, only time: what is there when a machine dies.
  std::filesystem::remove(file);
  UniaxialOptions short_test = options;
  short_test.max_strain = 2e-6;
  run(short_test, {.file = file, .seconds_between = 0});
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(Resume, WithoutAFileAStoppedTestSaysSoAndWithoutACheckpointItStartsAnew) {
  const UniaxialOptions options = options_for(Loading::tension);
  EXPECT_THROW(run(options, {.stop_after = 5}), dem::Interrupted);
  expect_same_bits(run(options, {.file = file, .resume = true}), run(options));
}

TEST_F(Resume, RefusesACheckpointOfAnotherSpecimenCardOrTest) {
  const UniaxialOptions options = options_for(Loading::tension);
  run_to(5, options);
  EXPECT_THAT(refusal(options, small_block(2), card),
              AllOf(HasSubstr("checkpoint.h5"), HasSubstr("another specimen")));
  dem::MaterialCard other = card;
  other.cohesion *= 1.0000001;
  EXPECT_THAT(refusal(options, small_block(), other), HasSubstr("another card"));
  other = card;
  other.unloading = dem::SofteningUnloading::elastic;
  EXPECT_THAT(refusal(options, small_block(), other), HasSubstr("another card"));
  UniaxialOptions slower = options;
  slower.damping = 0.2;
  EXPECT_THAT(refusal(slower, small_block(), card), HasSubstr("other options"));
  EXPECT_THAT(refusal(options_for(Loading::compression), small_block(), card), HasSubstr("other options"));
}

TEST_F(Resume, RefusesWhatIsNoCheckpointOrIsDamaged) {
  const UniaxialOptions options = options_for(Loading::tension);
  const auto refused = [&] {
    const std::string message = refusal(options, small_block(), card);
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
    return message;
  };
  std::ofstream(file) << "no HDF5";
  EXPECT_THAT(refused(), HasSubstr("not an HDF5 file"));
  dem::create_spall_file(file, "spall-specimen", 1, [](dem::Hdf5File&) {});
  EXPECT_THAT(refused(), HasSubstr("is a spall-specimen file, not a spall-checkpoint file"));
  dem::create_spall_file(file, "spall-checkpoint", 99, [](dem::Hdf5File&) {});
  EXPECT_THAT(refused(), HasSubstr("version 99"));
  dem::create_spall_file(file, "spall-checkpoint", 1, [](dem::Hdf5File&) {});
  EXPECT_THAT(refused(), HasSubstr("another specimen"));

  // Every truncation and a changed byte in any column.
  std::filesystem::remove(file);
  run_to(300, options);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto spoil = [&](const std::string& content) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
  };
  for (const double part : {0.0, 0.1, 0.5, 0.99}) {
    spoil(bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
    EXPECT_NE(refused(), "accepted") << part;
  }
  int hashes = 0;
  const std::size_t between = bytes.size() / 23;
  for (std::size_t at = bytes.size() / 3; at < bytes.size(); at += between) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    spoil(changed);
    const std::string message = refused();
    if (message.find("SHA-256") != std::string::npos) ++hashes;
  }
  EXPECT_GT(hashes, 8);
  spoil(bytes);
  EXPECT_NO_THROW(go_on(options));
}

TEST_F(Resume, ARefusedCheckpointChangesNothing) {
  const UniaxialOptions options = options_for(Loading::tension);
  run_to(5, options);
  dem::Assembly assembly = virtual_tests::make_assembly(small_block(), card);
  dem::StepRoom room(assembly);
  const std::string before = state_sha256(assembly);
  EXPECT_THROW(read_checkpoint(file, {{"specimen", "other"}}, assembly, room), dem::InputError);
  EXPECT_EQ(state_sha256(assembly), before);
  EXPECT_EQ(read_checkpoint(file, {}, assembly, room)["steps"], std::vector<double>{5});
  EXPECT_NE(state_sha256(assembly), before);
}

// The sum is right, the numbers are none that a run can have.
TEST_F(Resume, RefusesAContactOfElementsThatAreNotThere) {
  for (const std::int32_t other : {-1, 0, 3, 1 << 30}) {
    dem::Assembly written = scene::chain(3, scene::plain_law());
    const dem::StepRoom room(written);
    written.contacts.push(0, 1, 0.02, 1e-4, dem::born_broken);
    written.contacts.pad(3);
    written.contacts.b[0] = other;
    dem::write_checkpoint(file, {}, written, room, {});
    dem::Assembly fresh = scene::chain(3, scene::plain_law());
    dem::StepRoom fresh_room(fresh);
    try {
      dem::read_checkpoint(file, {}, fresh, fresh_room);
      FAIL() << other;
    } catch (const dem::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("is damaged: contact 0 joins elements 0 and ")) << other;
    }
  }
}

TEST(Progress, NeverPassesItsTotalAndTellsTheEndAfterThePeak) {
  for (const Loading loading : {Loading::tension, Loading::compression}) {
    UniaxialOptions options;
    options.loading = loading;
    std::vector<dem::Progress> reports;
    const UniaxialResult result = run_uniaxial(small_block(), {}, options,
                                               [&](const dem::Progress& report) { reports.push_back(report); });
    ASSERT_EQ(reports.size(), result.curve.size());
    const double end = static_cast<double>(result.steps);
    for (std::size_t k = 0; k < reports.size(); ++k) {
      EXPECT_LE(reports[k].done, reports[k].total);
      EXPECT_EQ(reports[k].done == reports[k].total, k + 1 == reports.size());
      // A guess, but never the strain limit, which is several times as far.
      EXPECT_LT(reports[k].total, 3 * end) << name_of(loading) << " point " << k;
      EXPECT_GT(reports[k].total, 0.3 * end) << name_of(loading) << " point " << k;
    }
    RecordProperty(std::string(name_of(loading)) + "_first_total_over_steps",
                   std::to_string(reports.front().total / end));
  }
}

TEST(ExpectedEnd, OfAnExponentialFallIsWhereItEnds) {
  virtual_tests::Curve curve;
  for (int k = 1; k <= 100; ++k) curve.push_back({.strain = 1e-6 * k, .stress = 1e4 * k});
  EXPECT_DOUBLE_EQ(virtual_tests::expected_end({}, 0, 2e-4, 0.1, 1), 2e-4);
  EXPECT_NEAR(virtual_tests::expected_end(curve, 99, 1e-5, 0.1, 1), 1.35e-4, 1e-9);  // still straight
  EXPECT_DOUBLE_EQ(virtual_tests::expected_end(curve, 99, 2e-4, 0.1, 1), 2e-4);
  EXPECT_DOUBLE_EQ(virtual_tests::expected_end(curve, 99, 2e-4, 0.1, 1.5e-4), 1.5e-4);
  for (int k = 1; k <= 100; ++k)
    curve.push_back({.strain = 1e-4 + 1e-6 * k, .stress = 1e6 * std::exp(-0.01 * k)});
  EXPECT_NEAR(virtual_tests::expected_end(curve, 99, 2e-4, 0.1, 1), 1e-4 + 1e-4 * std::log(10), 1e-8);
}
