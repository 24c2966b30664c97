// spall study: what it leaves, and that nothing is lost or done twice whatever happens to it on the way.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/command.h"

using cli::replaced;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

namespace {

/// Three specimens, three tests each; quick and rough.
const std::string small_study = R"(name = "small"
card = "card.toml"
[[specimen]]
name = "prism"
size = "0.3x0.2x0.2 m"
elements = 1100
seeds = "1-2"
[[specimen]]
name = "cube"
size = "0.25x0.25x0.25 m"
element_size = "22.6 mm"
seeds = 7
[[test]]
kind = "elastic"
[[test]]
kind = "tension"
rate = 0.1
stop_at = 0.8
[[test]]
kind = "compression"
rate = 0.1
stop_at = 0.95
)";
constexpr std::size_t all_tasks = 9;

class Study : public cli::Command {
 protected:
  void SetUp() override {
    cli::Command::SetUp();
    write("card.toml", replaced(cli::good_card, "36 MPa", "3.6 MPa"));
    write("study.toml", small_study);
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read(name)); }

  /// The result of a run that nobody disturbed, in `whole`.
  std::string undisturbed() const {
    const auto run = spall({"study", "run", "study.toml", "-o", "whole", "--quiet"});
    EXPECT_EQ(run.code, 0) << run.err;
    return read("whole/result.json");
  }
  /// Finished results by name, each with what tells whether it was written again: inode and time.
  std::map<std::string, std::pair<std::uint64_t, std::int64_t>> results(const std::string& output) const {
    std::map<std::string, std::pair<std::uint64_t, std::int64_t>> found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder / output / "tasks", none)) {
      struct stat about {};
      if (entry.path().extension() == ".json" && entry.path().filename().string()[0] != '.' &&
          ::stat(entry.path().c_str(), &about) == 0)
        found[entry.path().filename().string()] = {
            about.st_ino, about.st_mtim.tv_sec * 1'000'000'000 + about.st_mtim.tv_nsec};
    }
    return found;
  }
  bool wait_for_a_result(const std::string& output) const {
    for (int k = 0; k < 600; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(20)))
      if (!results(output).empty()) return true;
    return false;
  }
};

}  // namespace

TEST_F(Study, LeavesRowsSummaryAndReport) {
  const auto run = spall({"study", "study.toml", "-o", "out", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  EXPECT_EQ(nlohmann::json::parse(run.out), result);
  ASSERT_EQ(result["rows"].size(), all_tasks);
  for (const auto& row : result["rows"]) {
    for (const char* key : {"task", "specimen", "seed", "size", "elements", "test", "E", "nu", "links"})
      EXPECT_TRUE(row.contains(key)) << key;
    if (row["test"] != "elastic") {
      for (const char* key : {"peak_stress", "peak_strain", "broken_links", "damage", "steps", "time_step",
                              "energy_balance_error", "unbalanced_force_ratio", "state_sha256"})
        EXPECT_TRUE(row.contains(key)) << key;
    }
    EXPECT_FALSE(row.contains("wall_seconds"));
  }
  EXPECT_EQ(result["rows"][6]["elements"], 1354);  // 0.25^3 / 0.0226^3
  for (const char* name : {"E", "nu", "ft", "fc", "tension.peak_strain"})
    for (const char* key : {"mean", "std", "min", "max", "spread_rel"})
      EXPECT_TRUE(result["summary"][name][key].is_number()) << name << " " << key;
  EXPECT_GT(result["summary"]["fc"]["mean"], result["summary"]["ft"]["mean"]);
  EXPECT_EQ(result["summary"]["ft"]["count"], 3);
  EXPECT_THAT(files(), IsSupersetOf({"out/rows.csv", "out/run.json", "out/report.html"}));
  EXPECT_EQ(json("out/run.json")["inputs"].size(), 2u);
  EXPECT_THAT(read("out/report.html"), AllOf(HasSubstr("Study: small"), HasSubstr("prism"), HasSubstr("MPa")));

  // What a test of the same specimen by hand says.
  ASSERT_EQ(spall({"specimen", "make", "--size", "0.3x0.2x0.2 m", "--elements", "1100", "--seed", "2", "-o",
                   "s2.h5", "--quiet"})
                .code,
            0);
  ASSERT_EQ(
      spall({"test", "tension", "--specimen", "s2.h5", "--card", "card.toml", "--stop-at", "0.8", "--velocity",
             nlohmann::json(result["rows"][4]["velocity"]).dump() + " m/s", "-o", "hand", "--quiet"})
          .code,
      0);
  EXPECT_EQ(json("hand/result.json")["state_sha256"], result["rows"][4]["state_sha256"]);

  const std::string page = read("out/report.html"), table = read("out/rows.csv");
  std::filesystem::remove(folder / "out/report.html");
  std::filesystem::remove(folder / "out/rows.csv");
  ASSERT_EQ(spall({"study", "report", "study.toml", "-o", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read("out/rows.csv"), table);
  EXPECT_EQ(json("out/result.json"), result);
}

TEST_F(Study, TellsTheCardThatItReadThoughItIsGoneAtTheEnd) {
  const std::string card = read("card.toml");
  const pid_t child = start({"study", "run", "study.toml", "-o", "out", "--quiet"});
  ASSERT_TRUE(wait_for_a_result("out"));
  std::filesystem::remove(folder / "card.toml");
  const auto run = wait_for(child);
  ASSERT_EQ(run.code, 0) << run.err;
  const auto inputs = json("out/run.json")["inputs"];
  write("card.toml", card);
  ASSERT_EQ(spall({"study", "report", "study.toml", "-o", "out", "--quiet"}).code, 0);
  EXPECT_EQ(inputs, json("out/run.json")["inputs"]);
}

TEST_F(Study, NamesAFolderThatStandsWhereAResultShould) {
  ASSERT_EQ(spall({"study", "run", "study.toml", "-o", "out", "--tasks", "1", "--quiet"}).code, 0);
  ASSERT_EQ(results("out").size(), 1u);
  const auto file = folder / "out/tasks" / results("out").begin()->first;
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  EXPECT_THAT(refusal(2, {"study", "report", "study.toml", "-o", "out", "--quiet"}),
              HasSubstr(file.filename().string() + ": is a folder, and should be a file"));
}

TEST_F(Study, PartsMakeTheSameBitsAsTheWhole) {
  const std::string whole = undisturbed();
  for (const std::vector<std::string>& part :
       {std::vector<std::string>{"--tasks", "8"}, {"--share", "2/2", "--threads", "1"}, {"--share", "1/2"}}) {
    std::vector<std::string> words{"study", "run", "study.toml", "-o", "out", "--json"};
    words.insert(words.end(), part.begin(), part.end());
    const auto run = spall(words);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["failed"].size(), 0u);
    EXPECT_THAT(files(), Not(testing::Contains("out/result.json")));
  }
  const auto status = spall({"study", "status", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(nlohmann::json::parse(status.out)["done"], all_tasks);
  ASSERT_EQ(spall({"study", "report", "study.toml", "-o", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read("out/result.json"), whole);
  // A rank takes its share from what mpirun sets.
  const auto rank = shell("OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=2 " SPALL_BINARY
                          " study run study.toml -o out --share mpi --json");
  ASSERT_EQ(rank.code, 0) << rank.err;
  EXPECT_EQ(nlohmann::json::parse(rank.out)["ran"], 0);
}

TEST_F(Study, KilledAtAnyTimeItLosesNothingAndDoesNothingTwice) {
  const std::string whole = undisturbed();
  std::mt19937 random(6);
  std::size_t interrupted = 0;
  for (int round = 0; round < 10; ++round) {
    const auto before = results("out");
    const pid_t child = start({"study", "run", "study.toml", "-o", "out", "--quiet"});
    std::this_thread::sleep_for(std::chrono::milliseconds(30 + random() % 400));
    ::kill(child, SIGKILL);
    interrupted += wait_for(child).code == 128 + SIGKILL ? 1 : 0;
    const auto after = results("out");
    for (const auto& [name, written] : before) {
      ASSERT_TRUE(after.contains(name)) << "lost " << name;
      EXPECT_EQ(after.at(name), written) << name << " was done twice";
    }
  }
  EXPECT_GE(interrupted, 1u);
  const auto before = results("out");
  const auto last = spall({"study", "run", "study.toml", "-o", "out", "--json"});
  ASSERT_EQ(last.code, 0) << last.err;
  const auto after = results("out");
  EXPECT_EQ(after.size(), all_tasks);
  for (const auto& [name, written] : before) EXPECT_EQ(after.at(name), written) << name << " was done twice";
  EXPECT_EQ(read("out/result.json"), whole);
  EXPECT_EQ(read("out/rows.csv"), read("whole/rows.csv"));
  // Beside the results nothing half-written stays. A kill may leave run.json's own in the folder, which nobody
  // reads.
  for (const std::string& name : files())
    EXPECT_TRUE(name.starts_with("out/.run.json.") || !name.ends_with(".part")) << name;
}

TEST_F(Study, TwoRunnersShareTheWorkOfOneFolder) {
  const std::string whole = undisturbed();
  const std::string command = SPALL_BINARY " study run study.toml -o out --tasks 1-9 --threads 1 --json";
  const auto both =
      shell(command + " > a.json & first=$!; " + command + " > b.json; second=$?; wait $first && exit $second");
  ASSERT_EQ(both.code, 0) << both.err;
  const auto a = json("a.json"), b = json("b.json");
  EXPECT_EQ(a["ran"].get<std::size_t>() + b["ran"].get<std::size_t>(), all_tasks);
  ASSERT_EQ(spall({"study", "report", "study.toml", "-o", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read("out/result.json"), whole);
}

TEST_F(Study, GoesOnAfterASignal) {
  const std::string whole = undisturbed();
  const pid_t child = start({"study", "run", "study.toml", "-o", "out", "--threads", "1"});
  ASSERT_TRUE(wait_for_a_result("out"));
  ::kill(child, SIGTERM);
  const auto stopped = wait_for(child);
  ASSERT_EQ(stopped.code, 3) << stopped.err;
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("of 9 tasks have their results in out"), HasSubstr("--resume")));
  EXPECT_THAT(files(), Not(testing::Contains("out/result.json")));
  const auto status = spall({"study", "status", "study.toml", "-o", "out"});
  EXPECT_THAT(status.out, AllOf(HasSubstr("of 9 tasks done"), HasSubstr("left")));
  const auto resumed = spall({"study", "run", "study.toml", "-o", "out", "--resume", "--quiet"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(read("out/result.json"), whole);
}

TEST_F(Study, AFailedTaskKeepsItsMessageAndIsRunAgainWhenAsked) {
  write("study.toml",
        replaced(small_study, "rate = 0.1\nstop_at = 0.95", "axis = \"x\"\nrate = 0.1\nstop_at = 0.95") +
            "[[specimen]]\nname = \"round\"\nshape = \"cylinder\"\nsize = \"0.25x0.25 m\"\n"
            "elements = 1100\nseeds = 1\n");
  const auto run = spall({"study", "run", "study.toml", "-o", "out"});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("1 of 12 tasks failed"), HasSubstr("round, seed 1, compression"),
                    HasSubstr("a cylinder cannot be loaded across its axis"), HasSubstr("--retry-failed")));
  const auto result = json("out/result.json");
  EXPECT_EQ(result["rows"].size(), 11u);
  ASSERT_EQ(result["failed"].size(), 1u);
  const std::string first = read("out/result.json");
  const auto again = spall({"study", "run", "study.toml", "-o", "out", "--quiet"});
  EXPECT_EQ(again.code, 1);
  const auto retried =
      spall({"study", "run", "study.toml", "-o", "out", "--tasks", "1-12", "--retry-failed", "--json"});
  EXPECT_EQ(retried.code, 1);
  EXPECT_EQ(nlohmann::json::parse(retried.out)["ran"], 1);
  EXPECT_EQ(read("out/result.json"), first);
  const auto status = spall({"study", "status", "study.toml", "-o", "out"});
  EXPECT_THAT(status.out, AllOf(HasSubstr("task 12 failed"), HasSubstr("11 of 12 tasks done")));
}

TEST_F(Study, AFullDiskIsAClearErrorAndTheResultsStay) {
  const std::string whole = undisturbed();
  // A mount of its own name space: nothing is left behind whatever happens.
  const std::string prefix = ::geteuid() == 0 ? "unshare -m" : "unshare -rm";
  if (shell(prefix + " mount -t tmpfs -o size=1m none /mnt").code != 0)
    GTEST_SKIP() << "mounting a small disk is not permitted here";
  write("full.sh",
        "mkdir out && mount -t tmpfs -o size=400k none out || exit 9\n" SPALL_BINARY
        " study run study.toml -o out --threads 1 --quiet; echo $? > full\n"
        "cp out/tasks/*.json . 2>/dev/null; ls out/tasks > there; mount -o remount,size=50m out || exit "
        "9\n" SPALL_BINARY
        " study run study.toml -o out --threads 1 --quiet || exit 8\ncp out/result.json result.json\n"
        "for kept in ????????????????????????????????????????????????????????????????.json; do\n"
        "  cmp $kept out/tasks/$kept || exit 7\ndone\n");
  const auto run = shell(prefix + " sh full.sh");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(read("full"), "1\n");
  EXPECT_THAT(run.err,
              AllOf(testing::AnyOf(HasSubstr("No space left on device"), HasSubstr("is the disk full?")),
                    HasSubstr("the same command goes on")));
  EXPECT_THAT(read("there"), Not(HasSubstr(".failed")));
  EXPECT_EQ(read("result.json"), whole);
}

TEST_F(Study, WrongCommandsAreRefusedBeforeAnythingIsWritten) {
  EXPECT_THAT(refusal(2, {"study"}), HasSubstr("study is required"));
  EXPECT_THAT(refusal(2, {"study", "study.toml"}), HasSubstr("--output"));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml"}), HasSubstr("--output"));
  EXPECT_THAT(refusal(2, {"study", "run", "none.toml", "-o", "out"}), HasSubstr("none.toml"));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--tasks", "1-10"}),
              AllOf(HasSubstr("--tasks"), HasSubstr("allowed: 1 to 9")));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--tasks", "x"}),
              HasSubstr("whole number"));
  for (const char* share : {"0/2", "3/2", "2", "a/b", "1/0", "mpi"})
    EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--share", share}),
                HasSubstr("--share"));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--memory", "1MB"}),
              HasSubstr("--memory"));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--memory", "much"}),
              HasSubstr("--memory"));
  EXPECT_THAT(refusal(2, {"study", "status", "study.toml", "-o", "out"}), HasSubstr("there is no such folder"));
  EXPECT_THAT(refusal(2, {"study", "report", "study.toml", "-o", "out"}), HasSubstr("there is no such folder"));
  EXPECT_THAT(refusal(2, {"study", "run", "study.toml", "-o", "out", "--retry-faild"}),
              HasSubstr("did you mean \"--retry-failed\"?"));
  EXPECT_THAT(refusal(1, {"study", "run", "study.toml", "-o", "/proc/spall"}), HasSubstr("/proc/spall"));
  write("out", "a file");
  EXPECT_THAT(refusal(1, {"study", "run", "study.toml", "-o", "out"}), HasSubstr("out"));
}

TEST_F(Study, AFolderThatCannotBeWrittenIsRefused) {
  std::filesystem::create_directory(folder / "out");
  const std::string prefix = ::geteuid() == 0 ? "unshare -m" : "unshare -rm";
  if (shell(prefix + " mount --bind out out").code != 0) GTEST_SKIP() << "mounting is not permitted here";
  const auto run =
      shell(prefix + " sh -c 'mount --bind out out && mount -o remount,bind,ro out && exec " SPALL_BINARY
                     " study run study.toml -o out'");
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("out"), HasSubstr("Read-only file system")));
}

TEST_F(Study, ThePlanListsTasksAndTheirCost) {
  const auto plan = spall({"study", "plan", "study.toml", "--json", "--threads", "2"});
  ASSERT_EQ(plan.code, 0) << plan.err;
  const auto json = nlohmann::json::parse(plan.out);
  ASSERT_EQ(json["tasks"].size(), all_tasks);
  EXPECT_EQ(json["tasks"][8]["task"], 9);
  EXPECT_EQ(json["tasks"][8]["specimen"], "cube");
  EXPECT_EQ(json["tasks"][8]["key"].get<std::string>().size(), 64u);
  EXPECT_GT(json["estimate"]["wall_seconds"], 0);
  EXPECT_EQ(json["estimate"]["specimens_to_pack"], 3);
  const auto words = spall({"study", "plan", "study.toml"});
  EXPECT_THAT(words.out, AllOf(HasSubstr("    9  cube, seed 7 (1354 elements): compression, about"),
                               HasSubstr("9 tasks, 3 specimens to pack")));
  EXPECT_EQ(files().size(), 2u);
}
