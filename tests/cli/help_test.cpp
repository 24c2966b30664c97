// The command line as such: --help of each verb, whose example works when pasted, and mistyped words.
#include <sstream>

#include "tests/cli/command.h"

using testing::AllOf;
using testing::HasSubstr;

class Help : public cli::Command, public testing::WithParamInterface<const char*> {
 protected:
  static std::vector<std::string> words(const std::string& line) {
    std::vector<std::string> result;
    bool quoted = false, inside = false;
    for (const char letter : line) {
      if (letter == ' ' && !quoted) {
        inside = false;
        continue;
      }
      if (!inside) result.emplace_back();
      inside = true;
      if (letter == '"')
        quoted = !quoted;
      else
        result.back() += letter;
    }
    return result;
  }
};

TEST_P(Help, HasAnExampleThatWorksWhenPasted) {
  std::vector<std::string> asked = words(GetParam());
  asked.push_back("--help");
  const auto help = spall(asked);
  ASSERT_EQ(help.code, 0) << help.err;
  EXPECT_EQ(help.err, "");
  EXPECT_THAT(help.out, AllOf(HasSubstr("--threads"), HasSubstr("--json"), HasSubstr("--quiet"),
                              HasSubstr("\nExample:\n")));
  std::istringstream lines(help.out.substr(help.out.find("\nExample:\n")));
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  spall ", 0) != 0) continue;
    std::vector<std::string> command = words(line);
    command.erase(command.begin());
    const auto outcome = spall(command);
    // 4: done, but a fit did not meet its tolerance.
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << line << "\n" << outcome.err;
    ++commands;
  }
  EXPECT_GE(commands, 1);
}

INSTANTIATE_TEST_SUITE_P(Verbs, Help,
                         testing::Values("specimen make", "specimen extract", "specimen inspect",
                                         "test elastic", "test tension", "test compression", "card show",
                                         "card check", "card export", "card example", "report"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

class CommandLine : public cli::Command {};

TEST_F(CommandLine, NamesTheVerbsAndTheVersion) {
  const auto help = spall({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("card"), HasSubstr("Exit codes")));
  EXPECT_THAT(spall({"--version"}).out, testing::StartsWith("spall 0."));
}

TEST_F(CommandLine, SuggestsWhatWasMeant) {
  EXPECT_THAT(refusal(2, {}), HasSubstr("spall: a verb is missing"));
  EXPECT_THAT(refusal(2, {"crad", "show"}), HasSubstr("did you mean \"card\"?"));
  EXPECT_THAT(refusal(2, {"card"}), HasSubstr("spall card: a verb is missing"));
  EXPECT_THAT(refusal(2, {"card", "shwo"}), HasSubstr("did you mean \"show\"?"));
  EXPECT_THAT(refusal(2, {"card", "show", "--jsn", "a.toml"}), HasSubstr("did you mean \"--json\"?"));
  EXPECT_THAT(refusal(2, {"card", "show"}), HasSubstr("card is required"));
  EXPECT_THAT(refusal(2, {"card", "show", "a.toml", "--threads", "0"}), HasSubstr("1 to 1024"));
  EXPECT_THAT(refusal(2, {"card", "show", "a.toml", "--threads", "two"}), HasSubstr("--threads"));
}
