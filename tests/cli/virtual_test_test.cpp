// spall test and spall report: what a run leaves, and what it refuses before it computes.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/command.h"

using cli::good_card;
using cli::replaced;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class VirtualTest : public cli::Command {
 protected:
  void SetUp() override {
    Command::SetUp();
    write("card.toml", good_card);
  }
  void make_specimen(const std::string& name = "s1.h5") {
    const auto made =
        spall({"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "1400", "-o", name, "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static std::vector<std::string> test(const std::string& kind, std::vector<std::string> more = {}) {
    std::vector<std::string> command{"test", kind, "--specimen", "s1.h5", "--card", "card.toml", "-o", "out"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read(name)); }
  void expect_keys(const nlohmann::json& object, const std::vector<std::string>& keys) const {
    for (const std::string& key : keys) EXPECT_TRUE(object.contains(key) && !object[key].is_null()) << key;
  }
};

TEST_F(VirtualTest, TakesAsManyThreadsAsTheEnvironmentSaysUnlessAnOptionDoes) {
  make_specimen();
  const std::string elastic =
      "OMP_NUM_THREADS=3 " SPALL_BINARY " test elastic --specimen s1.h5 --card card.toml --quiet -o ";
  ASSERT_EQ(shell(elastic + "three").code, 0);
  EXPECT_EQ(json("three/run.json")["threads"], 3);
  ASSERT_EQ(shell(elastic + "one --threads 1").code, 0);
  EXPECT_EQ(json("one/run.json")["threads"], 1);
}

TEST_F(VirtualTest, ElasticLeavesResultAndProvenance) {
  make_specimen();
  const auto run = spall(test("elastic", {"--json", "--threads", "1"}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto result = json("out/result.json");
  EXPECT_EQ(nlohmann::json::parse(run.out), result);
  expect_keys(result, {"E", "nu", "links", "elements", "wall_seconds"});
  EXPECT_NEAR(result["E"].get<double>(), 30e9, 30e9 * 0.1);
  const auto provenance = json("out/run.json");
  expect_keys(provenance,
              {"version", "commit", "command_line", "inputs", "seeds", "threads", "machine", "start", "end"});
  EXPECT_EQ(provenance["threads"], 1);
  EXPECT_EQ(provenance["seeds"][0], 1);
  ASSERT_EQ(provenance["inputs"].size(), 2u);
  EXPECT_EQ(provenance["inputs"][0]["sha256"].get<std::string>().size(), 64u);
  EXPECT_THAT(provenance["end"].get<std::string>(), testing::MatchesRegex("....-..-..T..:..:..Z"));
  EXPECT_THAT(files(), IsSupersetOf({"out/report.html"}));
  const auto report = spall({"report", "out"});
  EXPECT_EQ(report.code, 0) << report.err;
}

TEST_F(VirtualTest, TensionLeavesItsKeysAndCurves) {
  make_specimen();
  const auto run = spall(test("tension", {"--velocity", "0.05 m/s", "--ends", "fixed", "--stop-at", "0.6"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  expect_keys(result, {"peak_stress", "peak_strain", "E", "nu", "broken_links", "links", "damage", "steps",
                       "time_step", "threads", "step_loop_seconds", "wall_seconds", "energy_balance_error",
                       "unbalanced_force_ratio", "state_sha256"});
  EXPECT_EQ(result["ends"], "fixed");
  EXPECT_DOUBLE_EQ(result["velocity"].get<double>(), 0.05);
  EXPECT_GT(result["peak_stress"].get<double>(), 1e6);
  EXPECT_THAT(read("out/curves.csv"), testing::StartsWith("strain[-],stress[Pa]"));
}

TEST_F(VirtualTest, ListNamesEachTestWithALine) {
  const auto list = spall({"test", "--list"});
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* line :
       {"elastic      Young", "tension      Uniaxial", "compression  Uniaxial", "splitting    Brazilian",
        "bending      Three-point", "shear        Direct", "triaxial     Triaxial", "biaxial      Biaxial",
        "cyclic       Uniaxial", "spalling     Spalling"})
    EXPECT_THAT(list.out, HasSubstr(line));
}

TEST_F(VirtualTest, LaboratoryTestsLeaveTheirKeysCurvesAndFields) {
  make_specimen();
  struct Case {
    std::string kind;
    std::vector<std::string> options, keys;
    std::string header;
  };
  for (const Case& one :
       {Case{"splitting",
             {"--strip-width", "40 mm"},
             {"splitting_strength", "largest_force"},
             "closing[m],force[N]"},
        Case{"bending",
             {"--notch", "60 mm", "--stop-at", "0.8"},
             {"bending_strength", "fracture_energy", "span"},
             "displacement[m],force[N],stress[Pa],deflection[m],crack_mouth_opening[m]"},
        Case{"shear",
             {"--normal-stress", "1 MPa"},
             {"shear_strength", "normal_stress"},
             "displacement[m],force[N],stress[Pa],dilation[m],normal_stress[Pa]"},
        Case{"triaxial",
             {"--confinement", "2 MPa", "--max-displacement", "0.4 mm", "--uniaxial-strength", "15 MPa"},
             {"peak_stress", "peak_deviator", "confinement_factor", "confinement"},
             "closing[m],force[N],stress[Pa],strain[-],pressure[Pa]"},
        Case{"biaxial",
             {"--ratio", "0.5", "--free-axis", "y", "--max-displacement", "0.2 mm"},
             {"peak_stress", "second_stress_at_peak", "biaxial_modulus", "ratio"},
             "closing[m],force[N],stress[Pa],stress_2[Pa]"},
        Case{"cyclic",
             {"--loading", "tension", "--increment", "0.05 permil", "--max-displacement", "0.05 mm"},
             {"peak_stress", "cycles", "residual_strain", "loading"},
             "opening[m],force[N],stress[Pa],strain[-],cycle[-]"}}) {
    SCOPED_TRACE(one.kind);
    std::vector<std::string> more = one.options;
    more.insert(more.end(), {"--rate", "0.05", "--threads", "1"});
    const auto run = spall(test(one.kind, more));
    ASSERT_EQ(run.code, 0) << run.err;
    const auto result = json("out/result.json");
    expect_keys(result, one.keys);
    expect_keys(result,
                {"broken_links", "links", "damage", "steps", "time_step", "threads", "step_loop_seconds",
                 "wall_seconds", "energy_balance_error", "unbalanced_force_ratio", "state_sha256"});
    EXPECT_EQ(result["test"], one.kind);
    EXPECT_GT(result[one.keys[0]].get<double>(), 5e5);
    EXPECT_THAT(read("out/curves.csv"), testing::StartsWith(one.header));
    EXPECT_THAT(files(), IsSupersetOf({"out/fields.h5", "out/links.h5", "out/report.html"}));
    EXPECT_THAT(read("out/report.html"), HasSubstr("force"));
  }
}

TEST_F(VirtualTest, ASpallingBarLeavesItsKeysAndRefusesWhatDoesNotSuitIt) {
  const auto made =
      spall({"specimen", "make", "--size", "0.5x0.1x0.1 m", "--elements", "3200", "-o", "s1.h5", "--quiet"});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto run = spall(test("spalling", {"--static-strength", "2.5 MPa", "--pulse", "trapezoid"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  expect_keys(result, {"spall_strength", "fracture_stress", "strain_rate", "dynamic_increase_factor", "pulse",
                       "pulse_duration", "wave_speed", "energy_balance_error", "state_sha256"});
  EXPECT_FALSE(result.contains("quasi_static")) << "nothing has to balance";
  EXPECT_GT(result["spall_strength"].get<double>(), 1e6);
  EXPECT_THAT(read("out/curves.csv"), testing::StartsWith("time[s],free_end_velocity[m/s]"));
  EXPECT_THAT(files(), IsSupersetOf({"out/fields.h5", "out/links.h5", "out/report.html"}));
  EXPECT_THAT(refusal(2, test("spalling", {"--pulse-duration", "1 s"})),
              AllOf(HasSubstr("pulse-duration"), HasSubstr("allowed")));
  EXPECT_THAT(refusal(2, test("spalling", {"--pulse", "square"})), HasSubstr("--pulse"));
  EXPECT_THAT(refusal(2, test("spalling", {"--axis", "y"})), HasSubstr("long"));
}

TEST_F(VirtualTest, ARateCheckSaysWhatHalfTheSpeedDoes) {
  make_specimen();
  const auto run =
      spall(test("tension", {"--rate", "0.1", "--stop-at", "0.9", "--threads", "1", "--rate-check"}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("at half the speed peak stress is"));
  const auto result = json("out/result.json");
  const auto& check = result["rate_check"];
  EXPECT_EQ(check["quantity"], "peak_stress");
  EXPECT_DOUBLE_EQ(check["velocity"].get<double>(), 0.5 * result["velocity"].get<double>());
  EXPECT_NEAR(check["change"].get<double>(),
              check["value"].get<double>() / result["peak_stress"].get<double>() - 1, 1e-12);
}

TEST_F(VirtualTest, LaboratoryTestsRefuseWhatTheyCannotDo) {
  make_specimen();
  EXPECT_THAT(refusal(2, test("splitting", {"--strip-width", "1 mm"})),
              AllOf(HasSubstr("strip_width"), HasSubstr("elements")));
  EXPECT_THAT(refusal(2, test("splitting", {"--strip-width", "15"})), HasSubstr("--strip-width"));
  EXPECT_THAT(refusal(2, test("bending", {"--span", "0.5 m"})), AllOf(HasSubstr("span"), HasSubstr("allowed")));
  EXPECT_THAT(refusal(2, test("bending", {"--notch", "0.15 m"})), AllOf(HasSubstr("notch"), HasSubstr("0.6")));
  EXPECT_THAT(refusal(2, test("bending", {"--axis", "x", "--depth-axis", "x"})), HasSubstr("depth_axis"));
  EXPECT_THAT(refusal(2, test("bending", {"--velocity", "1 mm/s", "--rate", "0.1"})), HasSubstr("--rate"));
  EXPECT_THAT(refusal(2, test("shear", {"--gap", "0.5 m"})), AllOf(HasSubstr("gap"), HasSubstr("allowed")));
  EXPECT_THAT(refusal(2, test("shear", {"--normal-stress", "-1 MPa"})), HasSubstr("not positive"));
  EXPECT_THAT(refusal(2, test("triaxial", {"--confinement", "0 MPa"})), HasSubstr("not positive"));
  EXPECT_THAT(refusal(2, test("biaxial", {"--ratio", "1.5"})), HasSubstr("--ratio"));
  EXPECT_THAT(refusal(2, test("cyclic", {"--unload-to", "1"})), HasSubstr("--unload-to"));
  EXPECT_THAT(refusal(2, {"test", "spliting"}), HasSubstr("did you mean \"splitting\"?"));
  const auto made = spall({"specimen", "make", "--shape", "cylinder", "--size", "0.1x0.2 m", "--elements",
                           "1400", "-o", "s1.h5", "--quiet"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(refusal(2, test("bending")), HasSubstr("cylinder"));
  EXPECT_THAT(refusal(2, test("biaxial")), HasSubstr("cylinder"));
  EXPECT_THAT(refusal(2, test("splitting", {"--axis", "z"})), HasSubstr("axis"));
}

TEST_F(VirtualTest, WrongInputsAreRefusedBeforeAnythingIsWritten) {
  make_specimen();
  EXPECT_THAT(refusal(2, test("tension", {"--velocity", "0.02"})),
              AllOf(HasSubstr("--velocity"), HasSubstr("m/s")));
  EXPECT_THAT(refusal(2, test("tension", {"--velocity", "-1 m/s"})), HasSubstr("not positive"));
  EXPECT_THAT(refusal(2, test("tension", {"--velocity", "1 kg"})), HasSubstr("velocity"));
  EXPECT_THAT(refusal(2, test("tension", {"--damping", "nan"})), HasSubstr("--damping"));
  EXPECT_THAT(refusal(2, test("tension", {"--damping", "1.5"})), HasSubstr("--damping"));
  EXPECT_THAT(refusal(2, test("tension", {"--stop-at", "2"})), HasSubstr("--stop-at"));
  EXPECT_THAT(refusal(2, test("tension", {"--max-strain", "3 m"})), HasSubstr("--max-strain"));
  EXPECT_THAT(refusal(2, test("tension", {"--axis", "w"})), HasSubstr("--axis"));
  EXPECT_THAT(refusal(2, test("tension", {"--ends", "glued"})), HasSubstr("--ends"));
  EXPECT_THAT(refusal(2, test("tension", {"--dampng", "0.1"})), HasSubstr("did you mean \"--damping\"?"));
  write("card.toml", replaced(good_card, "\"30 GPa\"", "30"));
  EXPECT_THAT(refusal(2, test("elastic")), AllOf(HasSubstr("card.toml:1: E"), HasSubstr("\"30 GPa\"")));
  write("card.toml", good_card);
  const std::string bytes = read("s1.h5");
  write("s1.h5", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(refusal(2, test("compression")), HasSubstr("s1.h5"));
  std::filesystem::remove(folder / "s1.h5");
  EXPECT_THAT(refusal(2, test("compression")), HasSubstr("s1.h5"));
}

TEST_F(VirtualTest, AFolderThatCannotBeWrittenIsExitCode1) {
  make_specimen();
  write("out", "a file where the folder should be");
  EXPECT_THAT(refusal(1, test("compression")), HasSubstr("out"));
  EXPECT_THAT(refusal(1, {"test", "elastic", "--specimen", "s1.h5", "--card", "card.toml", "-o", "/proc/x"}),
              HasSubstr("/proc/x"));
}

TEST_F(VirtualTest, ASignalEndsItWithExitCode3AndResumeGoesOnToTheSameBits) {
  make_specimen();
  // Slow enough to be running for seconds.
  const std::vector<std::string> command = test("compression", {"--velocity", "0.012 m/s", "--threads", "1"});
  std::vector<std::string> elsewhere = command;
  *std::find(elsewhere.begin(), elsewhere.end(), "out") = "whole";
  ASSERT_EQ(spall(elsewhere).code, 0);

  const pid_t child = start(command);
  // Its first line of progress says that it is running.
  for (int k = 0; k < 2400 && read(".said/err").find("steps") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGINT);
  const auto stopped = wait_for(child);
  ASSERT_EQ(stopped.code, 3) << stopped.err;
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("out/checkpoint.h5"), HasSubstr("--velocity '0.012 m/s'"),
                                 HasSubstr("--threads 1 --resume\n")));
  EXPECT_THAT(files(), Not(testing::Contains("out/result.json")));

  // Only the same inputs may go on.
  std::vector<std::string> resume = command;
  resume.push_back("--resume");
  write("card.toml", replaced(good_card, "36 MPa", "35 MPa"));
  EXPECT_THAT(refusal(2, resume), AllOf(HasSubstr("checkpoint.h5"), HasSubstr("another card")));
  write("card.toml", good_card);
  const std::string checkpoint = read("out/checkpoint.h5");
  write("out/checkpoint.h5", checkpoint.substr(0, checkpoint.size() / 2));
  EXPECT_THAT(refusal(2, resume), HasSubstr("checkpoint.h5"));
  write("out/checkpoint.h5", checkpoint);

  // What the message says, pasted into a shell.
  const std::string said = stopped.err.substr(stopped.err.find("go on with ") + 11);
  const auto resumed = shell(said);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const auto result = json("out/result.json"), whole = json("whole/result.json");
  for (const char* key : {"state_sha256", "steps", "peak_stress", "peak_strain", "E", "nu", "broken_links",
                          "energy_balance_error"})
    EXPECT_EQ(result[key], whole[key]) << key;
  EXPECT_EQ(read("out/curves.csv"), read("whole/curves.csv"));
  EXPECT_EQ(read("out/fields.h5"), read("whole/fields.h5"));
  EXPECT_EQ(read("out/links.h5"), read("whole/links.h5"));
  EXPECT_THAT(files(), Not(testing::Contains("out/checkpoint.h5")));
  // And the same pictures, those from before the stop among them.
  const auto series = json("whole/frames/elements.hdf.series");
  EXPECT_EQ(json("out/frames/elements.hdf.series"), series);
  ASSERT_GE(series["files"].size(), 12u);
  EXPECT_LE(series["files"].size(), 25u);
  for (const auto& frame : series["files"]) {
    const std::string name = "/frames/" + frame["name"].get<std::string>();
    EXPECT_EQ(read("out" + name), read("whole" + name)) << name;
  }
}

TEST_F(VirtualTest, ASignalInTheRateCheckKeepsTheSecondTestsState) {
  make_specimen();
  const pid_t child = start(test("compression", {"--threads", "1", "--rate-check"}));
  // Its curve is there when the first of the two tests is over.
  for (int k = 0; k < 24000 && !std::filesystem::exists(folder / "out/curves.csv"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, SIGINT);
  const auto stopped = wait_for(child);
  EXPECT_EQ(stopped.code, 3) << stopped.err;
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("once more at half the speed: go on with "),
                                 HasSubstr("--threads 1 --rate-check --resume\n")));
  EXPECT_THAT(files(), testing::Contains("out/checkpoint_half_speed.h5"));
  // It is what the second test goes on from: in its place no other file will do.
  const std::string kept = read("out/checkpoint_half_speed.h5");
  write("out/checkpoint_half_speed.h5", "none");
  const auto resume = test("compression", {"--threads", "1", "--rate-check", "--resume", "--quiet"});
  EXPECT_THAT(refusal(2, resume), HasSubstr("checkpoint_half_speed.h5"));
  write("out/checkpoint_half_speed.h5", kept);
  EXPECT_EQ(spall(resume).code, 0);
  EXPECT_TRUE(json("out/result.json").contains("rate_check"));
  EXPECT_THAT(files(), Not(testing::Contains(HasSubstr("checkpoint"))));
}

TEST_F(VirtualTest, ResumeWithoutACheckpointSaysSoAndStartsAnew) {
  make_specimen();
  const auto run = spall(test("tension", {"--max-strain", "0.01 permil", "--threads", "1", "--resume"}));
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("nothing to go on from"));
  EXPECT_THAT(files(), IsSupersetOf({"out/result.json", "out/fields.h5", "out/links.h5"}));
}

TEST_F(VirtualTest, TheReportShowsTheSpecimenInSpaceUnlessNoFramesAreWanted) {
  make_specimen();
  ASSERT_EQ(spall(test("tension", {"--frames", "3"})).code, 0);
  const auto frames = json("out/frames/elements.hdf.series")["files"];
  EXPECT_GE(frames.size(), 3u);
  EXPECT_LE(frames.size(), 7u);
  EXPECT_THAT(frames.back()["label"].get<std::string>(), AllOf(HasSubstr("strain"), HasSubstr("MPa")));
  EXPECT_THAT(read("out/report.html"), HasSubstr("In space"));
  ASSERT_EQ(
      spall({"test", "tension", "--specimen", "s1.h5", "--card", "card.toml", "-o", "bare", "--frames", "0"})
          .code,
      0);
  EXPECT_FALSE(std::filesystem::exists(folder / "bare/frames"));
  EXPECT_THAT(read("bare/report.html"), Not(HasSubstr("In space")));
  EXPECT_EQ(json("bare/result.json")["state_sha256"], json("out/result.json")["state_sha256"]);
  EXPECT_THAT(refusal(2, test("tension", {"--frames", "-1"})), HasSubstr("--frames"));
  write("out/frames/elements.hdf.series", "{");
  EXPECT_THAT(refusal(2, {"report", "out"}), HasSubstr("elements.hdf.series"));
}

TEST_F(VirtualTest, ReportNeedsAFinishedRun) {
  EXPECT_THAT(refusal(2, {"report", "nowhere"}), HasSubstr("no such folder"));
  EXPECT_THAT(refusal(2, {"report", "."}), HasSubstr("result.json"));
  write("result.json", "{ half");
  EXPECT_THAT(refusal(2, {"report", "."}), HasSubstr("not JSON"));
}
