// Checkpoints that are damaged, of another kind or of another version: refused with a reason, or read as they
// were.
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "calibrate/test_bench.h"
#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "libdem/io/hdf5.h"
#include "libdem/run/checkpoint.h"
#include "libdem/run/checkpoint_interval.h"
#include "tests/cli/command.h"
#include "tests/verification/scene.h"

using testing::AllOf;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

/// A state of moving elements, as virtual tests, studies and impacts keep it, with numbers beside it.
struct StateFile {
  dem::Assembly assembly = scene::chain(12, scene::plain_law());
  dem::StepRoom room{assembly};
  dem::Belonging belongs_to{{"specimen", std::string(64, 'a')}};

  void write(const fs::path& file) {
    scene::shake(assembly.particles, 0.1, 3);
    dem::write_checkpoint(file, belongs_to, assembly, room, {{"record", {1, 2, 3}}, {"curve", {0.5, 0.25}}});
  }
};

/// What a reader got from the file, as text; the text of its refusal after "refused: ".
std::string read_state(const fs::path& file) {
  StateFile other;
  try {
    const dem::NamedNumbers numbers = dem::read_checkpoint(file, other.belongs_to, other.assembly, other.room);
    return dem::state_sha256(other.assembly) + nlohmann::json(numbers).dump();
  } catch (const dem::InputError& refusal) {
    return std::string("refused: ") + refusal.what();
  }
}

calibrate::TestSummary summary(double peak) {
  calibrate::TestSummary made;
  made.peak_stress = peak, made.steps = 1200, made.passed_peak = true;
  for (int k = 0; k < 50; ++k) made.curve.push_back({1e-6 * k, peak * k / 50, 0, 0, 0, 0});
  made.measured = {3e6, 1e-3};
  return made;
}

const std::vector<std::string> keys{std::string(64, 'a'), std::string(64, 'b')};

void write_journal(const fs::path& file) {
  calibrate::TestJournal journal(file, false);
  for (const std::string& key : keys) journal.add(key, summary(key[0] * 1e4));
  journal.save();
}

std::string read_journal(const fs::path& file) {
  try {
    const calibrate::TestJournal journal(file, true);
    nlohmann::json all = nlohmann::json::array({journal.size()});
    for (const std::string& key : keys) {
      const calibrate::TestSummary* found = journal.find(key);
      if (found == nullptr) return "a test is not there";
      nlohmann::json one{found->peak_stress, found->steps, found->passed_peak, found->measured};
      for (const auto& p : found->curve) one.push_back({p.strain, p.stress, p.broken});
      all.push_back(one);
    }
    return all.dump();
  } catch (const dem::InputError& refusal) {
    return std::string("refused: ") + refusal.what();
  }
}

struct Kind {
  std::string name;
  std::function<void(const fs::path&)> write;
  std::function<std::string(const fs::path&)> read;
};

const std::vector<Kind> kinds{{"state", [](const fs::path& file) { StateFile().write(file); }, read_state},
                              {"journal", write_journal, read_journal}};

class Checkpoint : public cli::Command {
 protected:
  fs::path file() const { return folder / "checkpoint.h5"; }
  void damage(const std::string& bytes) const { write("checkpoint.h5", bytes); }
};

}  // namespace

TEST_F(Checkpoint, ATurnedByteIsRefusedOrChangesNothing) {
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    kind.write(file());
    const std::string bytes = read("checkpoint.h5"), whole = kind.read(file());
    ASSERT_THAT(whole, testing::Not(HasSubstr("refused")));
    std::size_t refused = 0, tried = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 97, ++tried) {
      std::string other = bytes;
      other[at] = static_cast<char>(~other[at]);
      damage(other);
      const std::string found = kind.read(file());
      if (found.starts_with("refused: ")) {
        ++refused;
        EXPECT_THAT(found, AllOf(HasSubstr("checkpoint.h5"), testing::Not(HasSubstr("\n")))) << "byte " << at;
      } else {
        EXPECT_EQ(found, whole) << "byte " << at;
      }
    }
    RecordProperty(kind.name, std::to_string(refused) + " refused of " + std::to_string(tried));
    EXPECT_GT(refused, tried / 4);
  }
}

TEST_F(Checkpoint, ATruncatedOneIsRefused) {
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    kind.write(file());
    const std::string bytes = read("checkpoint.h5");
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 37) {
      damage(bytes.substr(0, length));
      EXPECT_THAT(kind.read(file()), testing::StartsWith("refused: ")) << length << " bytes";
    }
  }
}

TEST_F(Checkpoint, AnotherKindOrVersionIsRefusedWithAReason) {
  const auto rewritten = [&](const Kind& kind, const char* attribute, auto value) {
    kind.write(file());
    // Not by the library's own means: nothing in it changes a file in place.
    const std::string format = dem::Hdf5File::open(file()).text_attribute("/", "format");
    dem::Hdf5File made = dem::Hdf5File::create(file());
    made.set_attribute("/", "format", format);
    made.set_attribute("/", "format_version", std::int32_t{1});
    made.set_attribute("/", attribute, value);
    made.close();
    return kind.read(file());
  };
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    EXPECT_THAT(rewritten(kind, "format", "spall-specimen"),
                HasSubstr("is a spall-specimen file, not a spall-"));
    EXPECT_THAT(rewritten(kind, "format_version", std::int32_t{99}), HasSubstr("format version 99"));
    EXPECT_THAT(rewritten(kind, "format_version", std::int32_t{0}), HasSubstr("format version 0"));
  }
  EXPECT_THAT(rewritten(kinds[1], "format_version", std::int32_t{2}),
              AllOf(HasSubstr("format version 2"), HasSubstr("start anew")));
  kinds[1].write(file());
  EXPECT_THAT(read_state(file()),
              HasSubstr("is a spall-calibration-journal file, not a spall-checkpoint file"));
  kinds[0].write(file());
  EXPECT_THAT(read_journal(file()),
              HasSubstr("is a spall-checkpoint file, not a spall-calibration-journal file"));
}

TEST_F(Checkpoint, SaysInWordsWhatDiffers) {
  for (const auto& [what, words] :
       {std::pair("specimen", "another specimen;"), {"options", "other options;"}}) {
    StateFile state, other;
    state.belongs_to = {{what, std::string(64, 'a')}};
    state.write(file());
    other.belongs_to = {{what, std::string(64, 'b')}};
    try {
      dem::read_checkpoint(file(), other.belongs_to, other.assembly, other.room);
      ADD_FAILURE() << what;
    } catch (const dem::InputError& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr(std::string("belongs to a run with ") + words));
    }
  }
}

TEST_F(Checkpoint, AWrongIntervalIsRefusedBeforeAStudyOrAFitStarts) {
  write("card.toml", cli::good_card);
  write("study.toml",
        "card = \"card.toml\"\ntests = [\"tension\"]\n[[specimen]]\nsize = \"0.3x0.2x0.2 m\"\n"
        "elements = 1100\nseeds = 1\n");
  write("case.toml",
        "[targets]\nE = \"30 GPa\"\nft = \"3 MPa\"\n[fixed]\nzeta = 5\nCo = \"8 MPa\"\n"
        "[specimen]\nsize = \"0.4x0.2x0.2 m\"\nelements = 1400\n");
  ::setenv("SPALL_CHECKPOINT_SECONDS", "abc", 1);
  const std::string study = refusal(2, {"study", "run", "study.toml", "-o", "out", "--quiet"});
  const std::string fit = refusal(2, {"calibrate", "case.toml", "-o", "out", "--quiet"});
  ::unsetenv("SPALL_CHECKPOINT_SECONDS");
  for (const std::string& said : {study, fit})
    EXPECT_THAT(said, HasSubstr("spall: SPALL_CHECKPOINT_SECONDS: is \"abc\"; give a number from 0"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Checkpoint, AnEarlierJournalOfAFitLeadsToTheSameCard) {
  write("case.toml",
        "[targets]\nE = \"30 GPa\"\nft = \"3 MPa\"\n[fixed]\nzeta = 5\nCo = \"8 MPa\"\n"
        "[specimen]\nsize = \"0.36x0.2x0.2 m\"\nelements = 1000\nfit_seeds = [1]\ncheck_seeds = []\n");
  const std::vector<std::string> fit{"calibrate", "case.toml", "-o",        "out", "--frames",
                                     "0",         "--quiet",   "--threads", "1",   "--resume"};
  const int code = spall(fit).code;
  ASSERT_THAT(code, testing::AnyOf(0, 4));
  const std::string card = read("out/card.toml"), curves = read("out/curves.csv");
  const fs::path file = folder / "out/checkpoint.h5";
  const calibrate::TestJournal whole(file, true);
  const std::vector<std::string> all = dem::Hdf5File::open(file).names_in("tests");
  ASSERT_GE(all.size(), 4u);
  // As it was before the last rounds were saved, whichever they were.
  for (std::size_t odd : {0u, 1u}) {
    calibrate::TestJournal earlier(file, false);
    for (std::size_t k = odd; k < all.size(); k += 2) earlier.add(all[k], *whole.find(all[k]));
    earlier.save();
    for (const char* name : {"result.json", "card.toml", "curves.csv"}) fs::remove(folder / "out" / name);
    EXPECT_EQ(spall(fit).code, code);
    EXPECT_EQ(read("out/card.toml"), card);
    EXPECT_EQ(read("out/curves.csv"), curves);
    EXPECT_EQ(calibrate::TestJournal(file, true).size(), all.size());
  }
}

TEST_F(Checkpoint, AJournalIsSavedAtAPaceUnlessEveryRoundIsAskedFor) {
  calibrate::TestJournal paced(file(), false);
  paced.add(keys[0], summary(1));
  paced.save_if_due();
  EXPECT_FALSE(fs::exists(file())) << "a round later, within its first second";
  paced.save();
  EXPECT_EQ(calibrate::TestJournal(file(), true).size(), 1u);
  ::setenv("SPALL_CHECKPOINT_SECONDS", "0", 1);
  calibrate::TestJournal always(file(), true);
  ::unsetenv("SPALL_CHECKPOINT_SECONDS");
  always.add(keys[1], summary(2));
  always.save_if_due();
  EXPECT_EQ(calibrate::TestJournal(file(), true).size(), 2u);
}

TEST_F(Checkpoint, TheNextOneWaitsLongerThanWritingTookTwoHundredTimes) {
  using namespace std::chrono_literals;
  dem::CheckpointPace pace(0);
  EXPECT_TRUE(pace.is_due());
  pace.keep([] { std::this_thread::sleep_for(20ms); });
  EXPECT_FALSE(pace.is_due());
  std::this_thread::sleep_for(100ms);
  EXPECT_FALSE(pace.is_due());
  // After a quick one it is due soon, and not in the four seconds of the slow one.
  pace.keep([] {});
  const auto begun = std::chrono::steady_clock::now();
  while (!pace.is_due() && std::chrono::steady_clock::now() - begun < 2s) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(pace.is_due());
}

TEST_F(Checkpoint, TheCommandRefusesAnOlderJournalInOneLine) {
  std::filesystem::create_directory(folder / "out");
  {
    dem::Hdf5File made = dem::Hdf5File::create(folder / "out/checkpoint.h5");
    made.set_attribute("/", "format", "spall-calibration-journal");
    made.set_attribute("/", "format_version", std::int32_t{2});
    made.close();
  }
  write("case.toml",
        "[targets]\nE = \"30 GPa\"\nft = \"3 MPa\"\n[fixed]\nzeta = 5\nCo = \"8 MPa\"\n"
        "[specimen]\nsize = \"0.4x0.2x0.2 m\"\nelements = 1400\n");
  EXPECT_THAT(refusal(2, {"calibrate", "case.toml", "-o", "out", "--resume", "--quiet"}),
              AllOf(HasSubstr("out/checkpoint.h5"), HasSubstr("format version 2"), HasSubstr("start anew")));
}
