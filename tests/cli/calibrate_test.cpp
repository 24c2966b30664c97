// spall calibrate: what it leaves, how it goes on after a signal, and cases that it refuses.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/command.h"

using cli::replaced;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Calibrate : public cli::Command {
 protected:
  const std::string good_case = R"(name = "small"
[targets]
E = "30 GPa"
nu = 0.2
ft = "3 MPa"
[fixed]
zeta = 5
Co = "8 MPa"
[specimen]
size = "0.4x0.2x0.2 m"
elements = 1400
fit_seeds = [1]
check_seeds = [2]
)";
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read(name)); }
};

TEST_F(Calibrate, LeavesCardResultCurvesAndReport) {
  write("case.toml", good_case);
  const auto run = spall({"calibrate", "case.toml", "-o", "out", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  EXPECT_EQ(nlohmann::json::parse(run.out), result);
  for (const char* key : {"E", "nu", "T", "Co", "zeta", "phi_i", "phi_c", "alpha", "beta", "gamma"})
    EXPECT_TRUE(result["card"].contains(key)) << key;
  for (const auto& target : result["targets"])
    for (const char* key : {"name", "target", "achieved", "rel_error", "tolerance", "met"})
      EXPECT_TRUE(target.contains(key)) << key;
  for (const char* key : {"curves", "virtual_tests", "wall_seconds", "specimens"})
    EXPECT_TRUE(result.contains(key)) << key;
  EXPECT_THAT(files(), IsSupersetOf({"out/card.toml", "out/curves.csv", "out/report.html", "out/run.json",
                                     "out/checkpoint.h5"}));
  // The card comes back with the bits of the result.
  const auto card = spall({"card", "show", "out/card.toml", "--json"});
  ASSERT_EQ(card.code, 0) << card.err;
  const auto shown = nlohmann::json::parse(card.out);
  for (const char* key : {"E", "nu", "T", "Co", "zeta", "alpha", "beta", "gamma"})
    EXPECT_EQ(shown[key].get<double>(), result["card"][key].get<double>()) << key;
  EXPECT_EQ(json("out/run.json")["seeds"], (nlohmann::json{1, 2}));
}

TEST_F(Calibrate, ThePageHasTheNumbersAndComesAgainFromTheFiles) {
  // Three tension tests that differ a little: a mean and a band, though no curve is a target.
  for (int k = 0; k < 3; ++k) {
    std::string csv = "strain[permil],stress[MPa]\n";
    const double peak = 2.9 + 0.1 * k;
    for (int i = 0; i <= 60; ++i) {
      const double x = i / 30.0;  // 1 at the peak
      csv += std::to_string(0.1765 * x) + "," +
             std::to_string(peak * (x < 1 ? x * (2 - x) : 1 - 0.7 * (x - 1))) + "\n";
    }
    write("tension" + std::to_string(k) + ".csv", csv);
  }
  write("case.toml",
        replaced(good_case, "ft = \"3 MPa\"",
                 "ft = \"3 MPa\"\n[tension]\ncurves = [\"tension*.csv\"]\ngauge_length = \"100 mm\""));
  const auto run = spall({"calibrate", "case.toml", "-o", "out", "--quiet"});
  ASSERT_TRUE(run.code == 0 || run.code == 4) << run.err;
  const auto result = json("out/result.json");
  ASSERT_EQ(result["curves"].size(), 1u);
  EXPECT_EQ(result["curves"][0]["name"], "tension");
  EXPECT_GT(result["curves"][0]["rmse_rel"].get<double>(), 0);
  EXPECT_LT(result["curves"][0]["rmse_rel"].get<double>(), 0.5);
  for (const char* key :
       {"concrete", "notes", "history", "sensitivity", "laboratory", "unseen_targets", "ends"})
    EXPECT_TRUE(result.contains(key)) << key;
  EXPECT_EQ(result["elastic_fit"]["points"].size(), 10u);
  const std::string curves = read("out/curves.csv");
  EXPECT_THAT(curves, testing::StartsWith("test,curve,kind,strain[-],stress[Pa]\n"));
  for (const char* kind : {",fitted,", ",unseen,", ",laboratory,", ",band low,", ",band high,"})
    EXPECT_THAT(curves, HasSubstr(kind));

  const std::string page = read("out/report.html");
  for (const char* words :
       {"Tensile strength", "3 MPa", "30 GPa", "On specimens that the fit never saw",
        "laboratory, lowest to highest", "seed 1, fitted", "seed 2, unseen", "Ks/Kn", "Path of the parameters",
        "Softening ζ", "held at this value by", "In tension2.csv: gauge_length was not used"})
    EXPECT_THAT(page, HasSubstr(words));
  EXPECT_LT(page.size(), 5000000u);
  std::filesystem::remove(folder / "out/report.html");
  ASSERT_EQ(spall({"report", "out"}).code, 0);
  EXPECT_EQ(read("out/report.html"), page);
}

TEST_F(Calibrate, AResultOfAnotherShapeIsRefusedByThePage) {
  std::filesystem::create_directory(folder / "out");
  write("out/result.json", "{\"card\": 3, \"targets\": {\"E\": 30}}");
  EXPECT_THAT(refusal(2, {"report", "out"}), HasSubstr("result.json"));
}

TEST_F(Calibrate, ATargetOutOfReachIsExitCode4AndTheCardSaysSo) {
  // The bound holds T far below what 3 MPa needs.
  write("case.toml", replaced(good_case, "zeta = 5", "zeta = 5\nT = \"1 MPa\""));
  const auto run = spall({"calibrate", "case.toml", "-o", "out"});
  EXPECT_EQ(run.code, 4) << run.err;
  EXPECT_THAT(read("out/card.toml"), HasSubstr("MISSED"));
  EXPECT_THAT(files(), IsSupersetOf({"out/result.json"}));
}

TEST_F(Calibrate, FitsWhatAnotherLaboratoryTestMeasures) {
  const std::string splitting = R"([[test]]
kind = "splitting"
shape = "cylinder"
size = "0.2x0.2 m"
elements = 1200
targets = { splitting_strength = "3.6 MPa" }
tolerance = { splitting_strength = 0.08 }
)";
  std::string with = replaced(good_case, "zeta = 5\n", "");
  with = replaced(with, "check_seeds = [2]", "check_seeds = []") + splitting;
  write("case.toml", with);
  const auto run = spall({"calibrate", "case.toml", "-o", "out", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = json("out/result.json");
  bool found = false;
  for (const auto& target : result["targets"])
    if (target["name"] == "splitting.splitting_strength") {
      found = true;
      EXPECT_EQ(target["target"].get<double>(), 3.6e6);
      EXPECT_LT(std::abs(target["rel_error"].get<double>()), 0.08);
    }
  EXPECT_TRUE(found);
  EXPECT_THAT(read("out/card.toml"), HasSubstr("target_splitting.splitting_strength"));
  const auto refused = [&](const std::string& what, const std::string& by) {
    write("bad.toml", replaced(with, what, by));
    return refusal(2, {"calibrate", "bad.toml", "-o", "none"});
  };
  EXPECT_THAT(refused("kind = \"splitting\"", "kind = \"tension\""), HasSubstr("kind"));
  EXPECT_THAT(refused("{ splitting_strength = \"3.6 MPa\" }", "{ bending_strength = \"3.6 MPa\" }"),
              HasSubstr("bending_strength"));
  EXPECT_THAT(refused("targets = { splitting_strength = \"3.6 MPa\" }\n", ""), HasSubstr("targets"));
  EXPECT_THAT(refused("\"3.6 MPa\"", "3.6"), HasSubstr("its unit is missing"));
  EXPECT_THAT(refused("elements = 1200", "elements = 1200\nspan = \"0.3 m\""),
              AllOf(HasSubstr("span"), HasSubstr("splitting")));
}

TEST_F(Calibrate, FitsTheLawWithMomentsWhereTheCaseAsksForIt) {
  std::string with =
      replaced(good_case, "zeta = 5\nCo = \"8 MPa\"", "zeta = 5\nlink_law = \"moment_transfer\"");
  with = replaced(with, "ft = \"3 MPa\"", "ft = \"3 MPa\"\nfc = \"40 MPa\"");
  with = replaced(with, "check_seeds = [2]", "check_seeds = []");
  write("case.toml", with);
  const auto run = spall({"calibrate", "case.toml", "-o", "out", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;  // fc/ft of 13 at zeta 5: out of reach of the paper's law
  const auto card = json("out/result.json")["card"];
  EXPECT_EQ(card["link_law"], "moment_transfer");
  EXPECT_EQ(card["slip_softening"], 16);
  write("bad.toml", replaced(good_case, "zeta = 5", "zeta = 5\nrolling_limit = 0.5"));
  EXPECT_THAT(refusal(2, {"calibrate", "bad.toml", "-o", "none"}),
              AllOf(HasSubstr("rolling_limit"), HasSubstr("link_law = \"moment_transfer\"")));
}

TEST_F(Calibrate, GoesOnAfterASignalToTheSameCard) {
  write("case.toml", good_case);
  ASSERT_EQ(spall({"calibrate", "case.toml", "-o", "whole", "--quiet"}).code, 0);
  ::setenv("SPALL_CHECKPOINT_SECONDS", "0", 1);  // so that its first round can be seen
  const pid_t child = start({"calibrate", "case.toml", "-o", "out"});
  ::unsetenv("SPALL_CHECKPOINT_SECONDS");
  for (int k = 0; k < 2400 && !std::filesystem::exists(folder / "out/checkpoint.h5"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(child, SIGINT);
  const auto stopped = wait_for(child);
  ASSERT_EQ(stopped.code, 3) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("spall calibrate case.toml -o out --resume"));
  EXPECT_THAT(files(), Not(testing::Contains("out/result.json")));
  const auto resumed = spall({"calibrate", "case.toml", "-o", "out", "--resume"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(read("out/card.toml"), read("whole/card.toml"));
}

TEST_F(Calibrate, WrongCasesAreRefusedBeforeAnythingIsWritten) {
  const auto refused = [&](const std::string& what, const std::string& by) {
    write("case.toml", replaced(good_case, what, by));
    return refusal(2, {"calibrate", "case.toml", "-o", "out"});
  };
  EXPECT_THAT(refused("\"30 GPa\"", "30"), AllOf(HasSubstr("case.toml:3: targets.E"), HasSubstr("\"30 GPa\"")));
  EXPECT_THAT(refused("ft =", "ftt ="), AllOf(HasSubstr("unknown key"), HasSubstr("did you mean \"ft\"?")));
  EXPECT_THAT(refused("[specimen]", "[specimens]"), HasSubstr("did you mean \"specimen\"?"));
  EXPECT_THAT(refused("\"3 MPa\"", "\"3 m\""), HasSubstr("targets.ft"));
  EXPECT_THAT(refused("1400", "14"), HasSubstr("elements"));
  EXPECT_THAT(refusal(2, {"calibrate", "none.toml", "-o", "out"}), HasSubstr("none.toml"));
  write("case.toml", good_case);
  write("out", "a file");
  EXPECT_THAT(refusal(1, {"calibrate", "case.toml", "-o", "out"}), HasSubstr("out"));
}
