// What the runner is made of: claims, the queue, results as they are kept, and a whole small study run twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "libdem/core/interrupt.h"
#include "study/claims.h"
#include "study/plan_key.h"
#include "study/rows.h"
#include "study/runner.h"
#include "study/status.h"
#include "study/study_result.h"
#include "study/task_queue.h"
#include "tests/message_of.h"

using testing::ElementsAre;
using testing::HasSubstr;

namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  fs::path folder;
  void SetUp() override {
    folder = fs::temp_directory_path() /
             (std::string("spall-runner-") + testing::UnitTest::GetInstance()->current_test_info()->name() +
              "." + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
};

/// What `look` returns (0 to 100) in another process.
template <class Look>
int in_another_process(Look&& look) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(look());
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const std::string key_a(64, 'a'), key_b = "b" + std::string(63, 'a');

study::Job job(std::size_t task, double seconds, double bytes, std::size_t specimen) {
  study::Job made;
  made.task = task, made.seconds = seconds, made.bytes = bytes, made.specimen = specimen;
  return made;
}

/// Two small boxes, an elastic test each, at two tensile strengths: four tasks, two results.
study::Plan small_plan() {
  study::Study study;
  study.name = "small";
  study.file = "study.toml";
  study.cards.push_back({"card", "card.toml", {}});
  for (const std::uint64_t seed : {1u, 2u}) {
    study::SpecimenRecipe recipe;
    recipe.group = "box, small";
    recipe.packing.size = {0.3, 0.2, 0.2};
    recipe.packing.elements = 1100;
    recipe.packing.seed = seed;
    study.specimens.push_back(recipe);
  }
  study.tests.resize(1);
  study.tests[0].name = "elastic";
  study::Parameter strength;
  strength.key = "T", strength.kind = dem::Quantity::stress, strength.values = {2e6, 3e6};
  study.parameters = {strength};
  return study::make_plan(study);
}

std::vector<std::size_t> all_of(const study::Plan& plan) { return study::choose_tasks(plan, "", ""); }

}  // namespace

class Claims : public Folder {};

TEST_F(Claims, AreSeenByOtherProcessesAndGivenBackWhenTheirsEnds) {
  const fs::path file = folder / "claims";
  study::Claims own(file);
  ASSERT_TRUE(own.take(key_a));
  const auto other_takes = [&](const std::string& key) {
    return in_another_process([&] { return study::Claims(file).take(key) ? 1 : 0; });
  };
  EXPECT_EQ(other_takes(key_a), 0);
  EXPECT_EQ(other_takes(key_b), 1);
  EXPECT_EQ(in_another_process([&] { return study::Claims::held(file, key_a) ? 1 : 0; }), 1);
  EXPECT_EQ(in_another_process([&] { return study::Claims::held(file, key_b) ? 1 : 0; }), 0);
  EXPECT_TRUE(own.take(key_b)) << "the process that held it has ended";
  own.release(key_a);
  EXPECT_EQ(other_takes(key_a), 1);
}

TEST(TaskQueue, TakesTheLongestThatFits) {
  study::TaskQueue queue({job(0, 1, 10, 0), job(1, 5, 80, 1), job(2, 3, 30, 2), job(3, 2, 20, 3)}, 4, 100);
  const auto now = Clock::now();
  const auto task = [&](std::size_t index) { return queue[index].task; };
  const std::size_t first = queue.take(now), second = queue.take(now);
  EXPECT_EQ(task(first), 1u);
  EXPECT_EQ(task(second), 3u) << "30 do not fit beside 80, 20 do";
  EXPECT_EQ(queue.take(now), study::TaskQueue::none);
  queue.finish(first, false);
  EXPECT_EQ(task(queue.take(now)), 2u);
  EXPECT_FALSE(queue.all_done());
}

TEST(TaskQueue, OneThreadGetsASpecimenThenAllMayUseIt) {
  study::TaskQueue queue({job(0, 3, 1, 0), job(1, 2, 1, 0), job(2, 1, 1, 1)}, 2, 100);
  const auto now = Clock::now();
  const std::size_t first = queue.take(now);
  EXPECT_EQ(queue[first].task, 0u);
  EXPECT_EQ(queue[queue.take(now)].task, 2u) << "task 1 waits for its specimen";
  EXPECT_EQ(queue.take(now), study::TaskQueue::none);
  queue.specimen_ready(first);
  EXPECT_EQ(queue[queue.take(now)].task, 1u);
}

TEST(TaskQueue, LooksAgainAtWhatOthersDo) {
  study::TaskQueue queue({job(0, 1, 1, 0)}, 1, 100);
  const auto now = Clock::now();
  const std::size_t index = queue.take(now);
  queue.put_off(index, now + std::chrono::seconds(1));
  EXPECT_EQ(queue.take(now), study::TaskQueue::none);
  EXPECT_EQ(queue.take(now + std::chrono::seconds(2)), index);
  queue.finish(index, true);
  EXPECT_TRUE(queue.all_done());
}

TEST(TaskResult, ComesBackFromItsFileWithTheSameBits) {
  study::TaskResult result;
  result.key = key_a;
  result.values = {{"E", 1.0 / 3 * 1e10},
                   {"links", std::int64_t{12345}},
                   {"passed_peak", true},
                   {"ends", std::string("free")},
                   {"nu", std::numeric_limits<double>::quiet_NaN()}};
  result.curve.columns = {{"closing", "m"}, {"force", "N"}, {"broken", "-"}};
  result.curve.values = {1e-5 / 3, 2e6 / 7, 0.1, 2e-5 / 3, 3e6 / 7, 0.2};
  const auto back = study::result_from(nlohmann::ordered_json::parse(study::to_json(result).dump()), "x.json");
  EXPECT_EQ(back.key, key_a);
  ASSERT_EQ(back.values.size(), 5u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(back.values[k], result.values[k]);
  EXPECT_TRUE(std::isnan(study::number_of(back.values, "nu")));
  EXPECT_EQ(study::number_of(back.values, "links"), 12345);
  EXPECT_EQ(back.curve.values, result.curve.values);
  ASSERT_EQ(back.curve.columns.size(), 3u);
  EXPECT_EQ(back.curve.columns[1].name, "force");
  EXPECT_EQ(back.curve.columns[1].unit, "N");
}

class Runner : public Folder {};

TEST_F(Runner, RunsEachResultOnceAndAssemblesTheRows) {
  const study::Plan plan = small_plan();
  const study::StudyFolder out(folder / "out");
  const study::RunOutcome first = study::run_tasks(plan, all_of(plan), out, {.threads = 2});
  EXPECT_EQ(first.chosen, 4u);
  EXPECT_EQ(first.results, 2u);
  EXPECT_EQ(first.ran, 2u);
  EXPECT_TRUE(first.failures.empty());
  const std::string json = study::result_json(plan, study::read_rows(plan, out)).dump();
  const study::RunOutcome second = study::run_tasks(plan, all_of(plan), out, {});
  EXPECT_EQ(second.ran, 0u);

  const study::RowTable table = study::read_rows(plan, out);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[3].seed, 2u);
  EXPECT_THAT(table.rows[3].parameters, ElementsAre(3e6));
  EXPECT_EQ(table.rows[2].number("E"), table.rows[3].number("E")) << "T does not enter the elastic test";
  EXPECT_NE(table.rows[1].number("E"), table.rows[2].number("E"));
  EXPECT_NEAR(table.rows[0].number("E") / 30e9, 1, 0.1);
  const auto result = nlohmann::ordered_json::parse(json);
  EXPECT_EQ(result["rows"].size(), 4u);
  EXPECT_EQ(result["summary"]["E"]["count"], 4);
  EXPECT_EQ(result["settings"].size(), 2u);
  EXPECT_EQ(result["settings"][1]["summary"]["nu"]["count"], 2);
  const std::string csv = study::rows_csv(plan, table);
  EXPECT_THAT(csv, HasSubstr(",card.T[Pa],test,kind,E[Pa],nu[-],"));
  EXPECT_THAT(csv, HasSubstr("\n1,\"box, small\",box,1,0.3,0.2,0.2,1100,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);

  // Another folder, one thread: the same bits.
  const study::StudyFolder again(folder / "again");
  study::run_tasks(plan, all_of(plan), again, {});
  EXPECT_EQ(study::result_json(plan, study::read_rows(plan, again)).dump(), json);
}

TEST_F(Runner, KeepsAFailuresMessageAndRunsItAgainWhenAsked) {
  study::Plan plan = small_plan();
  plan.study.specimens[1].packing.size = {0.3, 0.05, 0.05};  // too thin: refused when it is packed
  for (study::Task& task : plan.tasks)
    task.key = study::task_key(plan.specimen_of(task), plan.card_of(task), plan.test_of(task));
  const study::StudyFolder out(folder / "out");
  const study::RunOutcome first = study::run_tasks(plan, all_of(plan), out, {});
  EXPECT_EQ(first.ran, 2u);
  ASSERT_EQ(first.failures.size(), 2u);
  EXPECT_EQ(first.failures[0].task, 2u);
  EXPECT_THAT(first.failures[0].message, HasSubstr("too small to be representative"));
  EXPECT_FALSE(out.concerns(first.failures[0].message));
  const study::RunOutcome second = study::run_tasks(plan, all_of(plan), out, {});
  EXPECT_EQ(second.ran, 0u);
  EXPECT_EQ(second.failures.size(), 2u);
  EXPECT_EQ(study::run_tasks(plan, all_of(plan), out, {.retry_failed = true}).ran, 1u);
  const study::StudyStatus status = study::status_of(plan, out);
  EXPECT_EQ(status.done, 2u);
  EXPECT_EQ(status.failed, 2u);
  const auto json = study::result_json(plan, study::read_rows(plan, out));
  EXPECT_EQ(json["failed"].size(), 2u);
  EXPECT_EQ(json["failed"][0]["task"], 3);
}

TEST_F(Runner, RefusesATaskThatNeedsMoreMemoryThanThereIs) {
  const study::Plan plan = small_plan();
  const study::StudyFolder out(folder / "out");
  EXPECT_THAT(test::message_of([&] { study::run_tasks(plan, all_of(plan), out, {.memory = 1e6}); }),
              testing::AllOf(HasSubstr("--memory"), HasSubstr("task 1")));
  EXPECT_FALSE(fs::exists(out.path()));
}

TEST_F(Runner, StopsWhenAskedAndGoesOn) {
  const study::Plan plan = small_plan();
  const study::StudyFolder out(folder / "out");
  dem::set_interrupt(true);
  EXPECT_THROW(study::run_tasks(plan, all_of(plan), out, {}), dem::Interrupted);
  dem::set_interrupt(false);
  EXPECT_EQ(study::run_tasks(plan, all_of(plan), out, {}).ran, 2u);
}

TEST_F(Runner, PacksADamagedSpecimenAnewAndSweepsWhatWasHalfWritten) {
  const study::Plan plan = small_plan();
  const study::StudyFolder out(folder / "out");
  out.make();
  std::ofstream(out.specimen(study::key_of(plan.study.specimens[0]))) << "not a specimen";
  const fs::path half = out.path() / "tasks" / ("." + plan.tasks[0].key + ".json.123.part");
  std::ofstream(half) << "{";
  EXPECT_EQ(study::run_tasks(plan, {0}, out, {}).failures.size(), 0u);
  EXPECT_FALSE(fs::exists(half));
  EXPECT_EQ(study::read_rows(plan, out).rows.size(), 2u) << "tasks 1 and 2 share the result";
}
