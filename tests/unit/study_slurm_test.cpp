// The Slurm part of the study room without a Slurm: what goes into the script, and how its answers are read.
// The answers are recorded from Slurm 22.05.8 (controller, node daemon and slurmdbd on one machine).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "libdem/core/error.h"
#include "study/slurm.h"
#include "study/slurm_command.h"
#include "study/slurm_queue.h"
#include "study/slurm_submission.h"
#include "tests/message_of.h"

using namespace study;
using test::message_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
namespace fs = std::filesystem;

namespace {

// An array of ten: one ended well, one with exit code 3, one ran into its limit, one was cancelled as it ran.
const std::string squeue_early = R"(1|3|CANCELLED|Resources
1|5|COMPLETED|None
1|0|COMPLETED|None
1|1|FAILED|NonZeroExitCode
1|7|PENDING|Resources
1|8|PENDING|Resources
1|6|RUNNING|None
1|2|RUNNING|None
)";
const std::string sacct_early = R"(1_0|COMPLETED|0:0
1_1|FAILED|3:0
1_2|RUNNING|0:0
1_3|CANCELLED by 0|0:0
1_[4-9]|PENDING|0:0
)";
const std::string sacct_late = R"(1_0|COMPLETED|0:0
1_1|FAILED|3:0
1_2|TIMEOUT|0:0
9_2|CANCELLED by 0|0:0
9_[3-9]|CANCELLED by 0|0:0
)";

std::vector<SlurmTask> some_tasks(std::size_t count, double seconds, double bytes = 1e8) {
  std::vector<SlurmTask> tasks;
  for (std::size_t k = 1; k <= count; ++k) tasks.push_back({k, seconds, bytes});
  return tasks;
}

SlurmPlace some_place() {
  SlurmPlace place;
  place.name = "small";
  place.program = "/opt/spall/bin/spall";
  place.study = "/home/a/study.toml";
  place.output = "/home/a/out";
  place.logs = "/home/a/out/slurm";
  place.working = "/home/a";
  return place;
}

}  // namespace

TEST(SlurmChunks, HoldTenMinutesOrWhatIsAskedFor) {
  const auto chunks = make_chunks(some_tasks(10, 250), {});
  ASSERT_THAT(chunks, SizeIs(5));
  EXPECT_THAT(chunks[1].tasks, ElementsAre(3, 4));
  EXPECT_DOUBLE_EQ(chunks[1].seconds, 500);
  SlurmOptions four;
  four.chunk = 4;
  const auto asked = make_chunks(some_tasks(10, 250), four);
  ASSERT_THAT(asked, SizeIs(3));
  EXPECT_THAT(asked[2].tasks, ElementsAre(9, 10));
  // A task that takes longer than a chunk should has one of its own.
  EXPECT_THAT(make_chunks(some_tasks(3, 5000), {}), SizeIs(3));
  EXPECT_THAT(make_chunks({}, {}), SizeIs(0));
}

TEST(SlurmChunks, OnSeveralCoresTakeAsLongAsTheirLongestTaskAtLeast) {
  SlurmOptions options;
  options.threads = 4;
  options.chunk = 5;
  auto tasks = some_tasks(5, 100, 1e9);
  tasks[0].seconds = 200;
  tasks[4].bytes = 3e9;
  const auto chunks = make_chunks(tasks, options);
  ASSERT_THAT(chunks, SizeIs(1));
  EXPECT_DOUBLE_EQ(chunks[0].seconds, 200);
  // The four largest at once, and the command.
  EXPECT_DOUBLE_EQ(chunks[0].bytes, 6e9 + 200e6);
}

TEST(SlurmChunks, TakeTasksInTheirOrderWithGaps) {
  SlurmOptions options;
  options.chunk = 4;
  const auto chunks = make_chunks({{12, 1, 1}, {3, 1, 1}, {2, 1, 1}, {1, 1, 1}, {7, 1, 1}}, options);
  ASSERT_THAT(chunks, SizeIs(2));
  EXPECT_EQ(range_text(chunks[0].tasks), "1-3,7");
  EXPECT_EQ(range_text(chunks[1].tasks), "12");
  EXPECT_EQ(range_text({}), "");
}

TEST(SlurmLimits, FollowTheEstimateUnlessGiven) {
  SlurmOptions options;
  const auto chunks = make_chunks(some_tasks(2, 500, 3e9), options);
  EXPECT_DOUBLE_EQ(time_limit(chunks, options), 2040);  // 4 x 500 s, in whole minutes
  EXPECT_DOUBLE_EQ(memory_limit(chunks, options), 2 * 3.2e9);
  options.time_factor = 2;
  EXPECT_DOUBLE_EQ(time_limit(chunks, options), 1020);
  EXPECT_DOUBLE_EQ(time_limit(make_chunks(some_tasks(1, 1), {}), options), 300);  // never under five minutes
  options.time_limit = 60;
  options.memory = 1e9;
  EXPECT_DOUBLE_EQ(time_limit(chunks, options), 60);
  EXPECT_DOUBLE_EQ(memory_limit(chunks, options), 1e9);
}

TEST(SlurmScript, SaysWhatEachElementRuns) {
  SlurmOptions options;
  options.chunk = 2;
  options.threads = 2;
  options.partition = "long";
  options.account = "p1";
  options.time_limit = 26.5 * 3600;
  options.memory = 1048576.0 * 1500;
  options.sbatch_options = {"--constraint=avx512"};
  const std::string script = batch_script(some_place(), make_chunks(some_tasks(5, 60), options), options);
  EXPECT_EQ(script, R"(#!/bin/bash
# Study "small": written by `spall study run --on slurm`.
#SBATCH "--job-name=spall-small"
#SBATCH "--array=0-2"
#SBATCH "--time=1-02:30:00"
#SBATCH "--mem=1500M"
#SBATCH "--nodes=1"
#SBATCH "--ntasks=1"
#SBATCH "--cpus-per-task=2"
#SBATCH "--chdir=/home/a"
#SBATCH "--output=/home/a/out/slurm/%A_%a.log"
#SBATCH "--partition=long"
#SBATCH "--account=p1"
#SBATCH "--constraint=avx512"
tasks=(
  1-2
  3-4
  5
)
exec '/opt/spall/bin/spall' study run '/home/a/study.toml' -o '/home/a/out' --tasks "${tasks[SLURM_ARRAY_TASK_ID]}" --threads 2 --memory 1572864000
)");
}

TEST(SlurmScript, KeepsOddNamesWhole) {
  SlurmPlace place = some_place();
  place.name = "a \"b\"\n#c";
  place.output = "/home/it's 100%";
  place.logs = "/home/it's 100%/slurm";
  place.arguments = {"--retry-failed"};
  const std::string script = batch_script(place, make_chunks(some_tasks(1, 60), {}), {});
  EXPECT_THAT(script, HasSubstr("#SBATCH \"--job-name=spall-a \\\"b\\\" #c\"\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH \"--output=/home/it's 100%%/slurm/%A_%a.log\"\n"));
  EXPECT_THAT(script, HasSubstr(" -o '/home/it'\\''s 100%' --tasks"));
  EXPECT_THAT(script, HasSubstr(" '--retry-failed'\n"));
  place.logs = "/home/a\\b/slurm";
  EXPECT_THAT(message_of([&] { batch_script(place, make_chunks(some_tasks(1, 60), {}), {}); }),
              HasSubstr("backslash"));
  place.output = "/home/two\nlines";
  EXPECT_THAT(message_of([&] { batch_script(place, make_chunks(some_tasks(1, 60), {}), {}); }),
              HasSubstr("line break"));
}

TEST(SlurmOptions, RefuseWhatTheStudySetsItself) {
  const auto refusal = [](const std::string& option) {
    SlurmOptions options;
    options.sbatch_options = {"--qos=high", option};
    return message_of([&] { check(options, "--sbatch-option"); });
  };
  EXPECT_THAT(refusal("--array=0-3"),
              AllOf(HasSubstr("--sbatch-option: "), HasSubstr("--array is set by the study")));
  EXPECT_THAT(refusal("-a0-3"), HasSubstr("set by the study"));
  EXPECT_THAT(refusal("--output=x"), HasSubstr("set by the study"));
  EXPECT_THAT(refusal("qos=high"), HasSubstr("no option of sbatch"));
  EXPECT_THAT(refusal("--comment=a\nrm -r b"), HasSubstr("line break"));
  SlurmOptions fine;
  fine.sbatch_options = {"--qos=high", "-Cavx512", "--comment=array of a study"};
  EXPECT_NO_THROW(check(fine, ""));
  fine.time_factor = 0.5;
  EXPECT_THAT(message_of([&] { check(fine, "--time-factor"); }), HasSubstr("at least 1"));
}

TEST(SlurmQueue, ReadsSqueue) {
  const ElementStates states = parse_squeue(squeue_early);
  ASSERT_THAT(states, SizeIs(8));
  EXPECT_EQ(states.at({"1", 0}).state, JobState::finished);
  EXPECT_EQ(states.at({"1", 1}).state, JobState::failed);
  EXPECT_EQ(states.at({"1", 1}).reason, "NonZeroExitCode");
  EXPECT_EQ(states.at({"1", 2}).state, JobState::running);
  EXPECT_EQ(states.at({"1", 2}).reason, "");
  EXPECT_EQ(states.at({"1", 3}).state, JobState::cancelled);
  EXPECT_EQ(states.at({"1", 7}).state, JobState::pending);
  EXPECT_EQ(states.at({"1", 7}).reason, "Resources");
  EXPECT_EQ(parse_squeue("1|2|TIMEOUT|TimeLimit\n").at({"1", 2}).state, JobState::timed_out);
  EXPECT_THAT(parse_squeue("CLUSTER: blue\n"), SizeIs(0));
  EXPECT_THAT(parse_squeue("12|N/A|RUNNING|None\n"), SizeIs(0));  // no array
  EXPECT_THAT(parse_squeue(""), SizeIs(0));
}

TEST(SlurmQueue, ReadsSacct) {
  const ElementStates early = parse_sacct(sacct_early);
  EXPECT_THAT(early, SizeIs(10));
  EXPECT_EQ(early.at({"1", 1}).state, JobState::failed);
  EXPECT_EQ(early.at({"1", 1}).reason, "exit code 3");
  EXPECT_EQ(early.at({"1", 3}).state, JobState::cancelled);
  EXPECT_EQ(early.at({"1", 9}).state, JobState::pending);
  const ElementStates late = parse_sacct(sacct_late);
  EXPECT_EQ(late.at({"1", 2}).state, JobState::timed_out);
  EXPECT_EQ(late.at({"9", 8}).state, JobState::cancelled);
  EXPECT_EQ(late.at({"9", 8}).word, "CANCELLED by 0");
}

TEST(SlurmQueue, ReadsTheListsThatSlurmShortens) {
  const ElementStates states = parse_sacct("17_[0-8:4,20%2]|PENDING|0:0\n18_[1,3,...]|PENDING|0:0\nx|y\n");
  EXPECT_THAT(states, SizeIs(6));
  for (const std::size_t index : {0u, 4u, 8u, 20u}) EXPECT_TRUE(states.contains({"17", index})) << index;
  EXPECT_TRUE(states.contains({"18", 3}));
}

TEST(SlurmQueue, KnowsSlurmsWords) {
  EXPECT_EQ(job_state("OUT_OF_MEMORY"), JobState::failed);
  EXPECT_EQ(job_state("OUT_OF_ME+"), JobState::failed);
  EXPECT_EQ(job_state("COMPLETING"), JobState::running);
  EXPECT_EQ(job_state("REQUEUE_HOLD"), JobState::pending);
  EXPECT_EQ(job_state("CANCELLED by 1000"), JobState::cancelled);
  EXPECT_TRUE(in_flight(JobState::pending));
  EXPECT_TRUE(in_flight(JobState::running));
  for (const JobState over :
       {JobState::finished, JobState::failed, JobState::timed_out, JobState::cancelled, JobState::gone})
    EXPECT_FALSE(in_flight(over)) << name_of(over);
}

TEST(SlurmMessage, IsOneLineInSlurmsWords) {
  CommandOutcome said;
  said.code = 1;
  said.err =
      "sbatch: error: invalid partition specified: nope\n"
      "sbatch: error: Batch job submission failed: Invalid partition name specified\n";
  EXPECT_EQ(slurm_message(said),
            "invalid partition specified: nope; Batch job submission failed: Invalid partition name specified");
  said.err = "sbatch: unrecognized option '--frob'\nTry \"sbatch --help\" for more information\n";
  EXPECT_EQ(slurm_message(said), "unrecognized option '--frob'");
  said.err = "slurm_load_jobs error: Invalid job id specified\n";
  EXPECT_EQ(slurm_message(said), "Invalid job id specified");
  said.err = "Slurm accounting storage is disabled\n";
  EXPECT_EQ(slurm_message(said), "Slurm accounting storage is disabled");
  said.err.clear();
  EXPECT_EQ(slurm_message(said), "exit code 1");
}

TEST(SlurmCommand, KeepsBothOutputsHoweverLong) {
  const CommandOutcome said =
      run_command({"sh", "-c", "head -c 300000 /dev/zero >&2; head -c 200000 /dev/zero; exit 7"});
  EXPECT_TRUE(said.found);
  EXPECT_EQ(said.code, 7);
  EXPECT_EQ(said.out.size(), 200000u);
  EXPECT_EQ(said.err.size(), 300000u);
  EXPECT_FALSE(run_command({"no-such-command-of-slurm"}).found);
  EXPECT_EQ(run_command({"sh", "-c", "kill -KILL $$"}).code, 128 + 9);
}

TEST(SlurmElements, SetSlurmsWordBesideTheResults) {
  Submission submission;
  submission.job = {"1", ""};
  submission.plan = "p";
  submission.chunks = {{1, 2}, {3, 4}, {5}, {6}};
  Submission older = submission;
  older.job = {"0", ""};
  older.plan = "another";
  older.chunks = {{1}};
  QueueAnswer answer;
  answer.jobs[submission.job][0] = {JobState::failed, "FAILED", "exit code 1"};
  answer.jobs[submission.job][1] = {JobState::running, "RUNNING", ""};
  const std::vector<TaskState> tasks{TaskState::done,    TaskState::failed, TaskState::done,
                                     TaskState::running, TaskState::done,   TaskState::missing};
  const auto elements = element_states({older, submission}, answer, tasks, "p");
  ASSERT_THAT(elements, SizeIs(5));
  EXPECT_TRUE(elements[0].other_plan);
  EXPECT_EQ(elements[0].done, 0u);
  EXPECT_EQ(elements[1].slurm.reason, "exit code 1");
  EXPECT_EQ(elements[1].done, 1u);
  EXPECT_EQ(elements[1].failed, 1u);
  EXPECT_EQ(elements[2].done, 1u);
  EXPECT_EQ(elements[2].missing, 1u);
  EXPECT_EQ(elements[3].slurm.state, JobState::finished) << "forgotten, with its result there";
  EXPECT_EQ(elements[4].slurm.state, JobState::gone) << "forgotten, without";
}

// Shell scripts in the place of Slurm's commands, which say what Slurm would.
class SlurmSubmission : public testing::Test {
 protected:
  fs::path folder;
  std::string path;

  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder = fs::temp_directory_path() / ("spall-slurm-" + test + "-" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "bin");
    path = std::getenv("PATH");
    ::setenv("PATH", ((folder / "bin").string() + ":/usr/bin:/bin").c_str(), 1);
    fake("scontrol", "echo 'MaxArraySize            = 3'");
    fake("sacct", "echo 'Slurm accounting storage is disabled' >&2; exit 1");
    fake("squeue", "cat " + (folder / "queue").string());
    // Numbers from 1, and every script is kept.
    fake("sbatch",
         "cd " + folder.string() + "; echo x >> count; n=$(wc -l < count); cp \"$2\" submitted-$n; echo $n");
    queue("");
  }
  void TearDown() override {
    ::setenv("PATH", path.c_str(), 1);
    fs::remove_all(folder);
  }
  void fake(const std::string& command, const std::string& script) const {
    const fs::path file = folder / "bin" / command;
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  void queue(const std::string& text) const { std::ofstream(folder / "queue") << text; }

  SlurmRequest request(std::size_t tasks, std::size_t chunk) const {
    SlurmRequest request;
    request.place = some_place();
    request.place.output = folder / "out";
    request.options.chunk = chunk;
    request.tasks = some_tasks(tasks, 60);
    request.states.assign(tasks, TaskState::missing);
    request.plan = "p";
    request.now = "2026-01-31T09:15:02Z";
    return request;
  }
};

TEST_F(SlurmSubmission, KeepsTheJobsNumberAndChunks) {
  const Submitted submitted = submit(request(5, 2));
  ASSERT_THAT(submitted.arrays, SizeIs(1));
  EXPECT_EQ(submitted.arrays[0].job.number, "1");
  EXPECT_TRUE(fs::exists(folder / "submitted-1"));
  const auto kept = read_submissions(folder / "out");
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_EQ(kept[0].job, submitted.arrays[0].job);
  EXPECT_EQ(kept[0].submitted, "2026-01-31T09:15:02Z");
  EXPECT_EQ(kept[0].script, "slurm/array-1.sh");
  EXPECT_DOUBLE_EQ(kept[0].time_limit, 480);
  EXPECT_THAT(kept[0].chunks, ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4), ElementsAre(5)));
}

TEST_F(SlurmSubmission, MakesSeveralArraysWhereOneWouldBeTooLong) {
  const Submitted submitted = submit(request(7, 1));
  ASSERT_THAT(submitted.arrays, SizeIs(3));
  EXPECT_THAT(submitted.arrays[1].chunks, ElementsAre(ElementsAre(4), ElementsAre(5), ElementsAre(6)));
  EXPECT_THAT(read_submissions(folder / "out"), SizeIs(3));
}

TEST_F(SlurmSubmission, LeavesOutWhatIsInFlight) {
  submit(request(5, 2));
  queue("1|0|RUNNING|None\n1|1|FAILED|NonZeroExitCode\n1|2|PENDING|Resources\n");
  const Submitted again = submit(request(5, 2));
  ASSERT_THAT(again.arrays, SizeIs(1));
  EXPECT_THAT(again.arrays[0].chunks, ElementsAre(ElementsAre(3, 4)));
  EXPECT_THAT(again.in_flight, ElementsAre(1, 2, 5));
  // Its script has a name of its own: the first one stays as it was submitted.
  EXPECT_EQ(again.arrays[0].script, "slurm/array-2.sh");
}

TEST_F(SlurmSubmission, RefusesWhenEverythingIsInFlight) {
  submit(request(2, 2));
  queue("1|0|PENDING|Resources\n");
  EXPECT_THAT(message_of<dem::RunError>([&] { submit(request(2, 2)); }),
              AllOf(HasSubstr("(1-2) are in flight already"), HasSubstr("nothing was submitted")));
  EXPECT_FALSE(fs::exists(folder / "submitted-2"));
  // Another version of the study numbers its tasks anew.
  SlurmRequest changed = request(2, 2);
  changed.plan = "q";
  EXPECT_THAT(message_of<dem::RunError>([&] { submit(changed); }), HasSubstr("scancel 1"));
  queue("");
  EXPECT_THAT(submit(changed).arrays, SizeIs(1));
}

TEST_F(SlurmSubmission, BelievesSqueueWhenAccountingIsLate) {
  submit(request(2, 1));
  fake("sacct", "printf '1_0|TIMEOUT|0:0\\n1_1|PENDING|0:0\\n'");
  fake("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  const SlurmStatus status = slurm_status(folder / "out", {TaskState::missing, TaskState::missing}, "p");
  ASSERT_THAT(status.elements, SizeIs(2));
  EXPECT_EQ(status.elements[0].slurm.state, JobState::timed_out);
  EXPECT_EQ(status.elements[1].slurm.state, JobState::gone);
  EXPECT_EQ(status.no_accounting, "");
  EXPECT_THAT(submit(request(2, 1)).arrays, SizeIs(1));
}

TEST_F(SlurmSubmission, SaysWhyThereIsNoAccounting) {
  EXPECT_THAT(slurm_status(folder / "out", {}, "p").elements, SizeIs(0)) << "nothing submitted, nobody asked";
  submit(request(1, 1));
  EXPECT_EQ(slurm_status(folder / "out", {TaskState::missing}, "p").no_accounting,
            "Slurm accounting storage is disabled");
  fs::remove(folder / "bin/sacct");
  ::setenv("PATH", (folder / "bin").c_str(), 1);
  fake("squeue", "exit 0");
  EXPECT_EQ(slurm_status(folder / "out", {TaskState::missing}, "p").no_accounting,
            "sacct is not on this machine");
}

TEST_F(SlurmSubmission, QuotesSlurmsRefusalAndLeavesNothingBehind) {
  fake("sbatch",
       "echo 'sbatch: error: Batch job submission failed: Invalid partition name specified' >&2; exit 1");
  EXPECT_THAT(
      message_of([&] { submit(request(2, 1)); }),
      AllOf(HasSubstr("sbatch: "), HasSubstr("Invalid partition name specified"), HasSubstr("--partition")));
  EXPECT_THAT(read_submissions(folder / "out"), SizeIs(0));
  EXPECT_FALSE(fs::exists(folder / "out/slurm/array-1.sh"));
  fake("sbatch",
       "echo 'sbatch: error: Batch job submission failed: Unable to contact slurm controller (connect "
       "failure)' >&2\n"
       "exit 1");
  EXPECT_THAT(message_of<dem::RunError>([&] { submit(request(2, 1)); }), HasSubstr("Unable to contact slurm"));
  fake("sbatch", "echo hello");
  EXPECT_THAT(message_of<dem::RunError>([&] { submit(request(2, 1)); }), HasSubstr("names no job"));
}

TEST_F(SlurmSubmission, NamesTheClusterOfSeveral) {
  fake("sbatch", "echo '77;blue'");
  submit(request(1, 1));
  EXPECT_EQ(read_submissions(folder / "out")[0].job, (JobName{"77", "blue"}));
  fake("squeue", "[ \"$6\" = --clusters=blue ] && printf 'CLUSTER: blue\\n77|0|RUNNING|None\\n'");
  const SlurmStatus status = slurm_status(folder / "out", {TaskState::missing}, "p");
  ASSERT_THAT(status.elements, SizeIs(1));
  EXPECT_EQ(status.elements[0].slurm.state, JobState::running);
}

TEST_F(SlurmSubmission, SaysThatThereIsNoSlurm) {
  fs::remove(folder / "bin/sbatch");
  ::setenv("PATH", (folder / "bin").c_str(), 1);
  EXPECT_THAT(message_of<dem::RunError>([&] { submit(request(1, 1)); }),
              AllOf(HasSubstr("sbatch is not on this machine"), HasSubstr("--tasks")));
}

TEST_F(SlurmSubmission, RefusesARecordThatIsNone) {
  fs::create_directories(folder / "out");
  for (const std::string text :
       {"{", "[]", "{\"format\": \"spall-study-slurm\", \"version\": 9}",
        "{\"format\": \"spall-study-slurm\", \"version\": 1, \"submissions\": [{}]}"}) {
    std::ofstream(folder / "out/slurm.json") << text;
    EXPECT_THAT(message_of([&] { read_submissions(folder / "out"); }), HasSubstr("slurm.json")) << text;
  }
}
