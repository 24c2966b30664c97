// The command line as such: --help of each verb, whose example works when pasted, and mistyped words.
#include <sstream>

#include "tests/cli/command.h"

using testing::AllOf;
using testing::HasSubstr;

class Help : public cli::Command, public testing::WithParamInterface<const char*> {};

TEST_P(Help, HasAnExampleThatWorksWhenPasted) {
  std::vector<std::string> asked;
  std::istringstream verb(GetParam());
  for (std::string word; verb >> word;) asked.push_back(word);
  asked.push_back("--help");
  const auto help = spall(asked);
  ASSERT_EQ(help.code, 0) << help.err;
  EXPECT_EQ(help.err, "");
  for (const char* option : {"--threads", "--json", "--quiet"}) EXPECT_THAT(help.out, HasSubstr(option));
  const auto begin = help.out.find("\nExample:\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string example = help.out.substr(begin + 10);
  EXPECT_THAT(example, HasSubstr("  spall " + std::string(GetParam())));
  write(".example.sh", example);
  const auto outcome =
      shell("PATH=" + std::filesystem::path(SPALL_BINARY).parent_path().string() + ":$PATH sh -e .example.sh");
  EXPECT_EQ(outcome.code, 0) << example << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Verbs, Help,
                         testing::Values("specimen make", "specimen extract", "specimen inspect",
                                         "test elastic", "test tension", "test compression", "test splitting",
                                         "test bending", "test shear", "test triaxial", "test biaxial",
                                         "test cyclic", "test spalling", "card show", "card check",
                                         "card export", "card example", "report", "calibrate", "impact",
                                         "study", "study plan", "study run", "study status", "study report"),
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
