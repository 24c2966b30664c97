// spall impact: what a run leaves, what it refuses before it computes, and how it goes on after a stop.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "libdem/io/hdf5.h"
#include "tests/cli/command.h"

using cli::good_card;
using cli::replaced;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

namespace {

/// A steel ball on a small slab: seconds.
const std::string slab = R"(title = "ball"
model = "de"
card = "card.toml"

[structure]
size = "0.24x0.24x0.08 m"
elements = 2000
compressive_strength = "36 MPa"

[[support]]
name = "low"
low = "0,0,0 m"
high = "0.03,0.24,0.08 m"
lock = ["z"]

[[support]]
name = "high"
low = "0.21,0,0 m"
high = "0.24,0.24,0.08 m"
lock = ["z"]

[impactor]
shape = "sphere"
diameter = "40 mm"
density = "7850 kg/m3"
speed = "20 m/s"
aim = "0.12,0.12,0.04 m"

[[probe]]
name = "under"
point = "0.12,0.12,0 m"

[run]
duration = "0.4 ms"
samples = 40

[output]
frames = 4
)";

class Impact : public cli::Command {
 protected:
  void SetUp() override {
    Command::SetUp();
    write("card.toml", good_card);
    write("slab.toml", slab);
  }
  static std::vector<std::string> impact(const std::string& output = "out",
                                         const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{"impact", "slab.toml", "-o", output};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  /// The exit code of a run that is told to stop once it moves.
  int stop_at_first_picture(pid_t child) const {
    for (int k = 0; k < 600 && !std::filesystem::exists(folder / "out/frames/elements_0001.hdf"); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ::kill(child, SIGINT);
    return wait_for(child).code;
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read(name)); }
};

}  // namespace

TEST_F(Impact, LeavesItsKeysHistoriesFramesAndPage) {
  const auto run = spall(impact("out", {"--json", "--threads", "1"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  EXPECT_EQ(nlohmann::json::parse(run.out), result);
  for (const char* key :
       {"model", "elements", "fe_nodes", "links", "steps", "time_step", "simulated_time", "wall_seconds",
        "max_displacement", "peak_force", "impulse", "residual_velocity", "broken_links", "damage_volume",
        "energy", "threads", "step_loop_seconds", "overlap_solve_seconds", "state_sha256"})
    EXPECT_TRUE(result.contains(key) && !result[key].is_null()) << key;
  EXPECT_EQ(result["model"], "de");
  EXPECT_EQ(result["fe_nodes"], 0);
  EXPECT_EQ(result["threads"], 1);
  // A ball of 0.263 kg at 20 m/s brings 52.6 J, and an impulse of 5.26 N s stops it.
  EXPECT_NEAR(result["energy"]["initial"].get<double>(), 52.6, 0.1);
  EXPECT_LT(std::abs(result["energy"]["balance_error"].get<double>()), 0.02);
  EXPECT_GT(result["impulse"].get<double>(), 1);
  EXPECT_LT(result["residual_velocity"].get<double>(), 20);
  EXPECT_GT(result["max_displacement"]["under"].get<double>(), 1e-5);
  EXPECT_EQ(result["formulas"]["apply"], true);

  EXPECT_THAT(files(),
              IsSupersetOf({"out/run.json", "out/curves.csv", "out/history.h5", "out/fragments.csv",
                            "out/report.html", "out/frames/elements_0000.hdf", "out/frames/links_0004.hdf",
                            "out/frames/impactor_0004.hdf", "out/frames/elements.hdf.series"}));
  EXPECT_THAT(files(), Not(Contains("out/checkpoint.h5")));
  EXPECT_THAT(read("out/curves.csv"), testing::StartsWith("time[s],displacement_under_x[m],"));
  const dem::Hdf5File history = dem::open_spall_file(folder / "out/history.h5", "spall-impact-history", 1);
  const auto time = history.read<double>("time");
  EXPECT_NEAR(time.back(), 0.4e-3, 1e-6);
  // The histories tell the same impulse and displacement as the result.
  const auto impulse = history.read<double>("impulse", 3);
  EXPECT_NEAR(impulse.back(), result["impulse_vector"][2].get<double>(), 1e-6);
  const auto series = json("out/frames/elements.hdf.series");
  ASSERT_EQ(series["files"].size(), 5u);
  EXPECT_EQ(series["files"][0]["time"], 0);
  EXPECT_NEAR(series["files"][4]["time"].get<double>(), 0.4e-3, 1e-6);
  const auto provenance = json("out/run.json");
  ASSERT_EQ(provenance["inputs"].size(), 2u);
  EXPECT_EQ(provenance["inputs"][0]["file"], "slab.toml");
  EXPECT_THAT(read("out/report.html"), AllOf(HasSubstr("Contact force"), HasSubstr("modified NDRC"),
                                             HasSubstr("Displacement along z"), HasSubstr("<svg")));
  EXPECT_EQ(spall({"report", "out"}).code, 0);
  // What the page draws is what the result says, in the unit on its axis.
  const auto largest = [&](const std::string& title, const std::string& unit, const std::string& named) {
    const std::string page = read("out/report.html"), mark = "<script type=\"application/json\"";
    for (std::size_t at = 0; (at = page.find(mark, at)) != std::string::npos;) {
      at = page.find('>', at) + 1;
      const auto chart = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
      if (chart["title"] != title) continue;
      EXPECT_EQ(chart["y"]["unit"], unit);
      double most = 0;
      for (const auto& line : chart["series"])
        if (line["name"] == named)
          for (const auto& y : line["y"])
            if (y.is_number()) most = std::max(most, std::abs(y.get<double>()));
      return most;
    }
    return -1.0;
  };
  EXPECT_NEAR(largest("Displacement along z", "mm", "under") /
                  (1e3 * result["max_displacement"]["under"].get<double>()),
              1, 0.1);
  EXPECT_NEAR(largest("Contact force", "kN", "along z") / (1e-3 * result["peak_force"].get<double>()), 1, 0.1);
}

TEST_F(Impact, WrongInputsAreRefusedAndNothingIsWritten) {
  const auto refused = [&](const std::string& what, const std::string& by) {
    write("slab.toml", replaced(slab, what, by));
    return refusal(2, impact());
  };
  EXPECT_THAT(refused("\"0.4 ms\"", "\"0 ms\""), HasSubstr("duration"));
  EXPECT_THAT(refused("\"20 m/s\"", "20"), AllOf(HasSubstr("speed"), HasSubstr("m/s")));
  EXPECT_THAT(refused("aim =", "aimm ="), HasSubstr("did you mean \"aim\"?"));
  EXPECT_THAT(refused("\"card.toml\"", "\"cart.toml\""), HasSubstr("cart.toml"));
}

TEST_F(Impact, TakesAnotherCardThanTheCaseNames) {
  write("fitted.toml", replaced(good_card, "T = \"3.1 MPa\"", "T = \"9.3 MPa\""));
  write("slab.toml", replaced(slab, "0.4 ms", "0.1 ms"));
  ASSERT_EQ(spall(impact("own", {"--threads", "1"})).code, 0);
  const auto other = spall(impact("out", {"--threads", "1", "--card", "fitted.toml"}));
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_LT(json("out/result.json")["broken_links"].get<int>(),
            json("own/result.json")["broken_links"].get<int>());
  EXPECT_EQ(json("out/run.json")["inputs"][1]["file"], "fitted.toml");
  EXPECT_THAT(refusal(2, impact("none", {"--card", "fited.toml"})), HasSubstr("fited.toml"));
}

TEST_F(Impact, WhatShowsOnlyOncePackedIsRefusedToo) {
  // Too thin a support to hold the centre of any element.
  write("slab.toml", replaced(slab, "high = \"0.03,0.24,0.08 m\"", "high = \"0.00001,0.24,0.08 m\""));
  EXPECT_THAT(refusal(2, impact("out", {"--quiet"})), HasSubstr("support \"low\""));
}

TEST_F(Impact, WhatShowsOnlyOncePackedCostsNoEarlierResult) {
  ASSERT_EQ(spall(impact("out", {"--quiet"})).code, 0);
  const auto contents = [&] {
    std::map<std::string, std::string> found;
    for (const std::string& name : files())
      if (name.starts_with("out/") && std::filesystem::is_regular_file(folder / name)) found[name] = read(name);
    return found;
  };
  const auto before = contents();
  ASSERT_TRUE(before.contains("out/result.json"));
  write("slab.toml", replaced(slab, "high = \"0.03,0.24,0.08 m\"", "high = \"0.00001,0.24,0.08 m\""));
  EXPECT_THAT(refusal(2, impact("out", {"--quiet"})), HasSubstr("support \"low\""));
  EXPECT_TRUE(contents() == before);
}

TEST_F(Impact, AFolderThatCannotBeWrittenIsExitCode1) {
  write("out", "a file where the folder should be");
  EXPECT_THAT(refusal(1, impact()), HasSubstr("out"));
}

TEST_F(Impact, ACheckpointBelongsToTheCaseThatWasReadThoughItWasEditedWhileItPacked) {
  const std::string long_one = replaced(slab, "0.4 ms", "4 ms");
  write("slab.toml", long_one);
  const pid_t child = start(impact("out", {"--threads", "1"}));
  // The folder is made when the case has been read, before it is packed.
  for (int k = 0; k < 5000 && !std::filesystem::exists(folder / "out"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  write("slab.toml", replaced(long_one, "20 m/s", "30 m/s"));
  ASSERT_EQ(stop_at_first_picture(child), 3);
  EXPECT_THAT(refusal(2, impact("out", {"--resume", "--quiet"})),
              HasSubstr("out/checkpoint.h5: belongs to a run with another case; go on with what it was"));
  write("slab.toml", long_one);
  const auto resumed = spall(impact("out", {"--resume", "--quiet"}));
  EXPECT_EQ(resumed.code, 0) << resumed.err;
}

TEST_F(Impact, GoesOnWithACardThatIsCalledAsTheCaseIs) {
  std::filesystem::create_directory(folder / "cards");
  write("cards/slab.toml", good_card);
  write("slab.toml", replaced(replaced(slab, "0.4 ms", "4 ms"), "card.toml", "cards/slab.toml"));
  ASSERT_EQ(stop_at_first_picture(start(impact("out", {"--threads", "1"}))), 3);
  write("cards/slab.toml", good_card + "# another\n");
  EXPECT_THAT(refusal(2, impact("out", {"--resume", "--quiet"})),
              HasSubstr("belongs to a run with another card;"));
  write("cards/slab.toml", good_card);
  const auto resumed = spall(impact("out", {"--resume", "--quiet"}));
  EXPECT_EQ(resumed.code, 0) << resumed.err;
}

TEST_F(Impact, ASignalEndsItWithExitCode3AndResumeGoesOnToTheSameBits) {
  write("slab.toml", replaced(slab, "0.4 ms", "4 ms"));
  const auto whole = spall(impact("whole", {"--threads", "1"}));
  ASSERT_EQ(whole.code, 0) << whole.err;
  const pid_t child = start(impact("out", {"--threads", "1"}));
  for (int k = 0; k < 600 && !std::filesystem::exists(folder / "out/frames/elements_0001.hdf"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(child, SIGINT);
  const auto stopped = wait_for(child);
  ASSERT_EQ(stopped.code, 3) << stopped.err;
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("out/checkpoint.h5"), HasSubstr("--threads 1 --resume\n")));
  EXPECT_THAT(files(), Not(Contains("out/result.json")));

  // What the message says, pasted into a shell.
  const auto resumed = shell(stopped.err.substr(stopped.err.find("go on with ") + 11));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const auto result = json("out/result.json"), expected = json("whole/result.json");
  for (const char* key : {"state_sha256", "steps", "peak_force", "impulse_vector", "broken_links", "energy"})
    EXPECT_EQ(result[key], expected[key]) << key;
  for (const char* name : {"curves.csv", "fragments.csv", "frames/elements.hdf.series",
                           "frames/elements_0004.hdf", "frames/links_0004.hdf"})
    EXPECT_TRUE(read(std::string("out/") + name) == read(std::string("whole/") + name)) << name;
  EXPECT_THAT(files(), Not(Contains("out/checkpoint.h5")));
}
