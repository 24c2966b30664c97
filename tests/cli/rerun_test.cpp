// A run over the folder of a finished one: what the earlier run ended with goes before anything new is there,
// and --resume leaves what is finished alone.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/cli/command.h"

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

namespace {

namespace fs = std::filesystem;

struct Verb {
  std::string name;
  std::vector<std::string> command;  ///< without -o
  std::vector<std::string> ends_with;
};

const std::vector<Verb> verbs{
    {"calibrate", {"calibrate", "case.toml", "--frames", "0"}, {"card.toml", "curves.csv"}},
    {"impact", {"impact", "slab.toml"}, {"curves.csv", "history.h5", "fragments.csv"}},
    {"test",
     {"test", "compression", "--specimen", "s1.h5", "--card", "card.toml", "--velocity", "0.05 m/s"},
     {"curves.csv", "fields.h5", "links.h5"}},
    {"study", {"study", "run", "study.toml"}, {"rows.csv"}}};

class Rerun : public cli::Command, public testing::WithParamInterface<Verb> {
 protected:
  void SetUp() override {
    Command::SetUp();
    write("card.toml", cli::replaced(cli::good_card, "36 MPa", "8 MPa"));
    write("case.toml",
          "[targets]\nE = \"30 GPa\"\nft = \"3 MPa\"\n[fixed]\nzeta = 5\nCo = \"8 MPa\"\n"
          "[specimen]\nsize = \"0.36x0.2x0.2 m\"\nelements = 1000\nfit_seeds = [1]\ncheck_seeds = []\n");
    write("slab.toml",
          "model = \"de\"\ncard = \"card.toml\"\n[structure]\nsize = \"0.24x0.24x0.08 m\"\nelements = 2000\n"
          "[[support]]\nname = \"edge\"\nlow = \"0,0,0 m\"\nhigh = \"0.03,0.24,0.08 m\"\nlock = [\"z\"]\n"
          "[impactor]\nshape = \"sphere\"\ndiameter = \"40 mm\"\ndensity = \"7850 kg/m3\"\nspeed = \"20 m/s\"\n"
          "aim = \"0.12,0.12,0.04 m\"\n[run]\nduration = \"1 ms\"\n[output]\nframes = 2\n");
    write("study.toml",
          "card = \"card.toml\"\n[[specimen]]\nsize = \"0.3x0.2x0.2 m\"\nelements = 1100\nseeds = 1\n"
          "[[test]]\nkind = \"tension\"\nrate = 0.1\nstop_at = 0.8\n");
    if (GetParam().name == "test") {
      ASSERT_EQ(
          spall({"specimen", "make", "--size", "0.36x0.2x0.2 m", "--elements", "1000", "-o", "s1.h5"}).code, 0);
    }
  }

  std::vector<std::string> words(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = GetParam().command;
    all.insert(all.end(), {"-o", "out", "--threads", "1"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  bool any_is_there(const std::vector<std::string>& names) const {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return fs::exists(folder / "out" / name); });
  }
  /// Done, with whatever the fit says of its tolerances.
  void expect_done(const cli::Outcome& outcome) const {
    EXPECT_THAT(outcome.code, testing::AnyOf(0, 4)) << outcome.err;
  }
};

}  // namespace

TEST_P(Rerun, KilledMidwayItLeavesNothingOfTheEarlierResultAndResumeMakesItAgain) {
  expect_done(spall(words({"--quiet"})));
  fs::copy(folder / "out", folder / "earlier", fs::copy_options::recursive);
  std::vector<std::string> finals = GetParam().ends_with;
  finals.insert(finals.end(), {"result.json", "run.json", "report.html"});
  int code = 0;
  for (int turn = 0; turn < 5 && code != 128 + SIGKILL; ++turn) {  // a busy machine may look too late
    if (GetParam().name == "study") fs::remove_all(folder / "out/tasks");
    const pid_t child = start(words({"--quiet"}));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (any_is_there(finals) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ::kill(child, SIGKILL);
    code = wait_for(child).code;
  }
  ASSERT_EQ(code, 128 + SIGKILL);
  for (const std::string& name : finals) EXPECT_THAT(files(), Not(Contains("out/" + name)));

  expect_done(spall(words({"--resume", "--quiet"})));
  for (const std::string& name : finals) EXPECT_THAT(files(), Contains("out/" + name));
  for (const std::string& name : GetParam().ends_with)
    EXPECT_TRUE(read("out/" + name) == read("earlier/" + name)) << name;
}

TEST_P(Rerun, ResumeOfAFinishedRunLeavesItAsItIs) {
  if (GetParam().name == "study") GTEST_SKIP() << "a study always looks for what is missing";
  const int code = spall(words({"--quiet"})).code;
  const std::string result = read("out/result.json");
  const fs::file_time_type time = fs::last_write_time(folder / "out/result.json");
  fs::remove(folder / "out/report.html");  // as if killed between the two
  const auto again = spall(words({"--resume"}));
  EXPECT_EQ(again.code, code);
  EXPECT_THAT(again.err, testing::EndsWith("out/result.json: the run is finished and stays as it is; without "
                                           "--resume it starts anew\n"));
  EXPECT_EQ(read("out/result.json"), result);
  EXPECT_EQ(fs::last_write_time(folder / "out/result.json"), time);
  EXPECT_THAT(files(), Contains("out/report.html"));
  EXPECT_EQ(spall(words({"--resume", "--json", "--quiet"})).out, result);

  // Another run's result is not this one's.
  for (const char* name : {"case.toml", "slab.toml", "card.toml"}) write(name, read(name) + "\n# changed\n");
  const auto other = spall(words({"--resume", "--json"}));
  EXPECT_EQ(other.code, code);
  EXPECT_THAT(other.err, Not(HasSubstr("is finished")));
  EXPECT_NE(fs::last_write_time(folder / "out/result.json"), time);
}

TEST_P(Rerun, WhatIsRefusedLeavesTheEarlierResultInItsPlace) {
  if (GetParam().name == "study") GTEST_SKIP() << "a damaged checkpoint costs a study no more than time";
  expect_done(spall(words({"--quiet"})));
  for (const char* name : {"case.toml", "slab.toml", "card.toml"}) write(name, read(name) + "\n# changed\n");
  write("out/checkpoint.h5", "no checkpoint");
  fs::copy(folder / "out", folder / "earlier", fs::copy_options::recursive);
  EXPECT_THAT(refusal(2, words({"--resume", "--quiet"})), HasSubstr("checkpoint.h5"));
  for (const auto& entry : fs::directory_iterator(folder / "earlier")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file()) {
      EXPECT_TRUE(read("out/" + name) == read("earlier/" + name)) << name;
    }
  }
  EXPECT_THAT(files(), testing::Each(Not(testing::EndsWith(".part"))));
}

INSTANTIATE_TEST_SUITE_P(Verbs, Rerun, testing::ValuesIn(verbs),
                         [](const auto& verb) { return verb.param.name; });
