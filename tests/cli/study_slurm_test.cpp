// spall study run --on slurm, against a real Slurm that slurm_here.sh starts on this machine for each test.
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/command.h"

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

namespace {

/// Four tasks of a moment each.
const std::string quick_study = R"(name = "quick"
card = "card.toml"
tests = ["elastic"]

[[specimen]]
size = "0.3x0.2x0.2 m"
elements = 1100
seeds = "1-4"
)";

class StudyOnSlurm : public cli::Command {
 protected:
  bool running = false;

  void SetUp() override {
    Command::SetUp();
    const cli::Outcome started = slurm_here("start");
    // Whether a Slurm comes up is up to the machine: what it lacks is told, and is no fault of Spall's.
    if (started.code != 0) GTEST_SKIP() << started.out << started.err;
    running = true;
    ::setenv("SLURM_CONF", (folder / "slurm/etc/slurm.conf").c_str(), 1);
    write("card.toml", cli::good_card);
    write("quick.toml", quick_study);
  }
  void TearDown() override {
    if (running) {
      EXPECT_EQ(slurm_here("stop").code, 0);
    }
    ::unsetenv("SLURM_CONF");
    Command::TearDown();
  }
  cli::Outcome slurm_here(const std::string& verb) const {
    return shell("bash " SPALL_SOURCE_DIR "/tests/cli/slurm_here.sh " + verb + " slurm 2");
  }

  /// spall study run STUDY -o OUT --on slurm, and more.
  static std::vector<std::string> submission(const std::string& study, const std::string& output,
                                             const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"study", "run", study, "-o", output, "--on", "slurm"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  nlohmann::json submit(const std::string& study, const std::string& output,
                        std::vector<std::string> more = {}) const {
    more.push_back("--json");
    const auto said = spall(submission(study, output, more));
    EXPECT_EQ(said.code, 0) << said.err;
    return said.code == 0 ? nlohmann::json::parse(said.out) : nlohmann::json();
  }
  nlohmann::json status(const std::string& study, const std::string& output) const {
    const auto said = spall({"study", "status", study, "-o", output, "--json"});
    EXPECT_EQ(said.code, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
  static std::vector<std::string> states(const nlohmann::json& status) {
    std::vector<std::string> states;
    for (const auto& element : status["slurm"]["elements"]) states.push_back(element["state"]);
    return states;
  }
  /// The status once nothing is in flight any more.
  nlohmann::json status_at_the_end(const std::string& study, const std::string& output) const {
    for (int turn = 0; turn < 600; ++turn) {
      const nlohmann::json now = status(study, output);
      const auto all = states(now);
      if (std::none_of(all.begin(), all.end(),
                       [](const std::string& state) { return state == "pending" || state == "running"; }))
        return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(400));
    }
    ADD_FAILURE() << "jobs are still in the queue: " << shell("squeue").out << read("slurm/log/slurmctld");
    return status(study, output);
  }
  /// What the elements of the jobs said, for whoever reads of a failure.
  std::string logs(const std::string& output) const {
    return shell("tail -n 5 " + output + "/slurm/*.log").out;
  }
};

}  // namespace

TEST_F(StudyOnSlurm, GivesTheSameBitsAsARunHere) {
  const std::string study = SPALL_SOURCE_DIR "/data/cases/study-small.toml";
  const auto submitted = submit(study, "there", {"--chunk", "3"});
  ASSERT_EQ(submitted["arrays"].size(), 1u);
  EXPECT_EQ(submitted["arrays"][0]["chunks"], (nlohmann::json{"1-3", "4-6", "7-9", "10-12"}));
  EXPECT_EQ(submitted["in_flight"], "");

  const auto there = status_at_the_end(study, "there");
  EXPECT_EQ(there["done"], 12) << logs("there");
  EXPECT_THAT(states(there), testing::Each("finished")) << logs("there");
  // A second time there is nothing to submit.
  EXPECT_EQ(submit(study, "there")["arrays"].size(), 0u);
  ASSERT_EQ(spall({"study", "report", study, "-o", "there"}).code, 0);

  ASSERT_EQ(spall({"study", "run", study, "-o", "here"}).code, 0);
  EXPECT_EQ(read("here/result.json"), read("there/result.json"));
  EXPECT_EQ(read("here/rows.csv"), read("there/rows.csv"));
  EXPECT_FALSE(read("here/result.json").empty());
}

TEST_F(StudyOnSlurm, SubmitsWhatIsNeitherDoneNorInFlight) {
  // Held, so that nothing starts before it should.
  const auto first = submit("quick.toml", "out", {"--chunk", "1", "--sbatch-option=--hold"});
  const std::string job = first["arrays"][0]["job"];
  EXPECT_THAT(states(status("quick.toml", "out")), testing::Each("pending"));
  EXPECT_EQ(states(status("quick.toml", "out")).size(), 4u);
  EXPECT_THAT(refusal(1, submission("quick.toml", "out")),
              AllOf(HasSubstr("1-4"), HasSubstr("in flight already"), HasSubstr("nothing was submitted")));

  ASSERT_EQ(shell("scancel " + job + "_1").code, 0);
  const auto second = submit("quick.toml", "out");
  ASSERT_EQ(second["arrays"].size(), 1u);
  EXPECT_EQ(second["arrays"][0]["chunks"], nlohmann::json{"2"});
  EXPECT_EQ(second["in_flight"], "1,3-4");

  ASSERT_EQ(shell("scontrol release " + job).code, 0);
  const auto end = status_at_the_end("quick.toml", "out");
  EXPECT_EQ(end["done"], 4) << logs("out");
  EXPECT_EQ(end["missing"], 0);
  EXPECT_NE(end["slurm"]["no_accounting"], "") << "this Slurm keeps no accounts";
}

TEST_F(StudyOnSlurm, TellsOfElementsThatFailAndSubmitsThemAgain) {
  // The element finds that its tasks do not fit into the memory it was given.
  submit("quick.toml", "out", {"--tasks", "2-3", "--chunk", "2", "--memory", "1MB"});
  const auto failed = status_at_the_end("quick.toml", "out");
  ASSERT_THAT(states(failed), testing::ElementsAre("failed")) << logs("out");
  EXPECT_EQ(failed["slurm"]["elements"][0]["reason"], "NonZeroExitCode");
  EXPECT_EQ(failed["slurm"]["elements"][0]["missing"], 2);
  const auto said = spall({"study", "status", "quick.toml", "-o", "out"});
  EXPECT_THAT(said.out, AllOf(HasSubstr("1 failed"), HasSubstr("tasks 2-3, 0 of 2 done"), HasSubstr("_0.log")));
  EXPECT_THAT(logs("out"), HasSubstr("memory"));

  EXPECT_EQ(submit("quick.toml", "out", {"--tasks", "2-3"})["arrays"][0]["chunks"], nlohmann::json{"2-3"});
  const auto end = status_at_the_end("quick.toml", "out");
  EXPECT_EQ(end["done"], 2) << logs("out");
}

TEST_F(StudyOnSlurm, WorksInFoldersWithOddNames) {
  const std::string odd = "it's 100% \"odd\" #1 $HOME";
  std::filesystem::create_directories(folder / odd);
  write(odd + "/card.toml", cli::good_card);
  write(odd + "/quick study.toml", quick_study);
  const std::string study = odd + "/quick study.toml", output = odd + "/out put";
  submit(study, output, {"--tasks", "1", "--sbatch-option=--comment=a # b"});
  EXPECT_EQ(status_at_the_end(study, output)["done"], 1);
  EXPECT_THAT(files(), Contains(testing::EndsWith("out put/slurm/1_0.log")));
}

TEST_F(StudyOnSlurm, QuotesWhatSlurmRefuses) {
  EXPECT_THAT(spall(submission("quick.toml", "out", {"--partition", "nowhere"})).err,
              AllOf(HasSubstr("spall: sbatch: "), HasSubstr("Invalid partition name specified")));
  EXPECT_EQ(spall(submission("quick.toml", "out", {"--partition", "nowhere"})).code, 2);
  EXPECT_THAT(refusal(2, submission("quick.toml", "out", {"--sbatch-option=--frob"})), HasSubstr("'--frob'"));
  EXPECT_THAT(files(), Not(Contains("out/slurm.json")));
}

// Without a Slurm.
class StudyWithoutSlurm : public cli::Command {};

TEST_F(StudyWithoutSlurm, SaysInOneLineWhatIsMissingOrWrong) {
  write("card.toml", cli::good_card);
  write("quick.toml", quick_study);
  const auto said = shell("PATH=/nowhere " SPALL_BINARY " study run quick.toml -o out --on slurm");
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.err, AllOf(HasSubstr("spall: sbatch is not on this machine"), HasSubstr("--tasks")));
  EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;

  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"study", "run", "quick.toml", "-o", "out", "--on", "slurm"};
    words.insert(words.end(), more.begin(), more.end());
    return refusal(2, words);
  };
  EXPECT_THAT(refused({"--time-limit", "90"}), AllOf(HasSubstr("--time-limit"), HasSubstr("unit")));
  EXPECT_THAT(refused({"--time-limit=-1 h"}), HasSubstr("more than 0"));
  EXPECT_THAT(refused({"--sbatch-option=--array=1-2"}), HasSubstr("--array is set by the study"));
  EXPECT_THAT(refused({"--chunk", "0"}), HasSubstr("--chunk"));
  EXPECT_THAT(refusal(2, {"study", "run", "quick.toml", "-o", "out", "--on", "slrm"}), HasSubstr("--on"));
  EXPECT_THAT(refusal(2, {"study", "run", "quick.toml", "-o", "out", "--chunk", "2"}), HasSubstr("--on"));
}
