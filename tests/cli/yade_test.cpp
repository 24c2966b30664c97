// What `spall card export` writes for Yade, run in Yade: every link has the card's stiffness and strength, and
// the specimen's Young's modulus and tensile strength come out as they do here. Skipped only where there is no
// Yade.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

namespace {

using Json = nlohmann::json;

class Yade : public cli::Command {
 protected:
  void SetUp() override {
    cli::Command::SetUp();
    if (shell("command -v yade").code != 0)
      GTEST_SKIP() << "there is no Yade on this machine; as root: apt-get install yade";
    write("card.toml", cli::good_card);
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "1200", "--seed", "1", "-o",
              "s1.h5"},
             {"card", "export", "card.toml", "--to", "csv", "--specimen", "s1.h5", "-o", "card.csv"},
             {"card", "export", "card.toml", "--to", "yade-jcfpm", "--specimen", "s1.h5", "-o", "jcfpm.py"},
             {"card", "export", "card.toml", "--to", "yade-cpm", "--specimen", "s1.h5", "-o", "cpm.py"}}) {
      const auto outcome = spall(arguments);
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
  }

  /// What yade_tension.py says of this script.
  Json pulled(const std::string& script, const std::string& aim) const {
    const auto outcome = shell(
        "OMP_NUM_THREADS=1 HOME=. SPALL_SCRIPT=" + script + " SPALL_LINKS=card.links.csv SPALL_AIM=" + aim +
        " SPALL_SIZE='0.4 0.2 0.2' SPALL_SPEED=0.02 timeout 280 yade -j1 -n -x " SPALL_SOURCE_DIR
        "/tests/cli/yade_tension.py");
    const auto at = outcome.out.find("RESULT ");
    EXPECT_NE(at, std::string::npos) << outcome.out << outcome.err;
    return at == std::string::npos
               ? Json()
               : Json::parse(outcome.out.substr(at + 7, outcome.out.find('\n', at) - at - 7));
  }

  Json tested(const std::string& test) const {
    const auto outcome = spall({"test", test, "--specimen", "s1.h5", "--card", "card.toml", "-o", "out/" + test,
                                "--threads", "1", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  /// A value in Yade over Spall's own, told for docs/exchange.md.
  static double ratio_of(const char* what, const Json& there, const Json& here) {
    const double ratio = there.get<double>() / here.get<double>();
    fmt::print("Yade over Spall, {}: {:.4f}\n", what, ratio);
    return ratio;
  }

  void expect_same_elasticity(const std::string& script) const {
    const Json there = pulled(script, "elastic"), here = tested("elastic");
    ASSERT_TRUE(there.is_object());
    EXPECT_EQ(there["links"], here["links"]);
    EXPECT_LT(there["worst_link"].get<double>(), 1e-9);
    EXPECT_NEAR(ratio_of("E", there["E"], here["E"]), 1, 0.005);
    EXPECT_NEAR(there["nu"].get<double>(), here["nu"].get<double>(), 0.005);
  }
};

}  // namespace

TEST_F(Yade, JcfpmHasTheCardsLinksAndModuli) { expect_same_elasticity("jcfpm.py"); }

TEST_F(Yade, CpmHasTheCardsLinksAndModuli) { expect_same_elasticity("cpm.py"); }

TEST_F(Yade, CpmHasTheSpecimensTensileStrength) {
  const Json there = pulled("cpm.py", "peak"), here = tested("tension");
  ASSERT_TRUE(there.is_object());
  EXPECT_NEAR(ratio_of("tensile strength", there["peak"], here["peak_stress"]), 1, 0.03);
  EXPECT_NEAR(ratio_of("strain at the peak", there["strain"], here["peak_strain"]), 1, 0.10);
}

// Without softening a link lets go at once: docs/exchange.md says how much that costs.
TEST_F(Yade, JcfpmBreaksBeforeTheSpecimenDoes) {
  const Json there = pulled("jcfpm.py", "peak"), here = tested("tension");
  ASSERT_TRUE(there.is_object());
  const double ratio = ratio_of("tensile strength", there["peak"], here["peak_stress"]);
  EXPECT_GT(ratio, 0.55);
  EXPECT_LT(ratio, 0.80);
}
