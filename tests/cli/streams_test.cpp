// What a shell may do to the command: streams that are full, closed or gone, signals, names that are devices or
// links, two runs in one folder.
#include <sys/file.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "libdem/core/sha256.h"
#include "tests/cli/command.h"

using testing::HasSubstr;
using testing::Not;

namespace {

namespace fs = std::filesystem;

class Streams : public cli::Command {
 protected:
  void SetUp() override {
    Command::SetUp();
    write("card.toml", cli::good_card);
  }
  /// `command` by a shell, with the program as $0.
  cli::Outcome shell(const std::string& command) const {
    return wait_for(start_program("sh", {"-c", command, SPALL_BINARY}));
  }
  void make_specimen() const {
    ASSERT_EQ(spall({"specimen", "make", "--size", "0.36x0.2x0.2 m", "--elements", "1000", "-o", "s1.h5"}).code,
              0);
  }
  /// A test that takes long enough to be hit.
  std::vector<std::string> long_test() const {
    return {"test",       "compression", "--specimen", "s1.h5",     "--card", "card.toml", "--velocity",
            "0.0005 m/s", "-o",          "out",        "--threads", "1",      "--quiet"};
  }
};

}  // namespace

TEST_F(Streams, AConsoleThatIsGoneEndsNothing) {
  EXPECT_EQ(shell("\"$0\" card check none.toml 2>/dev/full").code, 2);
  EXPECT_EQ(shell("\"$0\" card check none.toml 2>&-").code, 2);
  make_specimen();
  EXPECT_EQ(shell("\"$0\" test elastic --specimen s1.h5 --card card.toml -o out 2>/dev/full").code, 0);
  EXPECT_THAT(files(), testing::Contains("out/result.json"));
}

TEST_F(Streams, AResultThatStandardOutputLosesIsExitCode1) {
  for (const char* words :
       {"card show card.toml", "card show card.toml --json", "card export card.toml --to csv"}) {
    const auto full = shell(std::string("\"$0\" ") + words + " >/dev/full");
    EXPECT_EQ(full.code, 1) << words;
    EXPECT_EQ(full.err, "spall: standard output cannot be written (No space left on device)\n") << words;
    EXPECT_EQ(shell(std::string("\"$0\" ") + words + " >&-").code, 1) << words;
  }
}

TEST_F(Streams, NoFileOfARunTakesTheNumberOfAClosedStream) {
  EXPECT_EQ(shell("\"$0\" card example -o plain.toml").code, 0);
  shell("\"$0\" card example -o closed.toml >&- 2>&- <&-");
  EXPECT_EQ(read("closed.toml"), read("plain.toml"));
}

TEST_F(Streams, LinksLeadOnAndDevicesStayDevices) {
  fs::create_directories(folder / "there");
  fs::create_symlink("there/real.toml", folder / "link.toml");
  EXPECT_EQ(spall({"card", "example", "-o", "link.toml"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.toml"));
  EXPECT_THAT(read("there/real.toml"), HasSubstr("zeta"));
  EXPECT_THAT(shell("mkfifo pipe && (cat pipe >got & \"$0\" card example -o pipe >/dev/null; wait)").err, "");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_EQ(read("got"), read("there/real.toml"));
  EXPECT_THAT(refusal(1, {"specimen", "make", "--size", "0.36x0.2x0.2 m", "--elements", "1000", "-o", "pipe"}),
              HasSubstr("pipe: is a device or a pipe"));
}

TEST_F(Streams, ACardThroughAPipeIsKnownByWhatWasRead) {
  make_specimen();
  EXPECT_EQ(
      shell("cat card.toml | \"$0\" test elastic --specimen s1.h5 --card /dev/stdin -o piped --quiet").code, 0);
  EXPECT_THAT(read("piped/run.json"), HasSubstr(dem::sha256_of_file(folder / "card.toml")));
}

TEST_F(Streams, ARunDoesNotTakeThePlaceOfItsOwnInput) {
  std::string curve = "strain[-],stress[MPa]\n";
  for (int k = 0; k <= 30; ++k)
    curve += std::to_string(k * 1e-4) + "," + std::to_string(k * (2 - k / 30.0)) + "\n";
  write("curves.csv", curve);
  write("case.toml",
        "[targets]\nft = \"3 MPa\"\n[compression]\ncurves = [\"curves.csv\"]\n[fixed]\nCo = \"8 MPa\"\n");
  const std::string before = read("curves.csv");
  EXPECT_THAT(refusal(2, {"calibrate", "case.toml", "-o", "."}),
              HasSubstr("curves.csv: is an input of this run"));
  EXPECT_EQ(read("curves.csv"), before);
}

TEST_F(Streams, TwoRunsAtOnceInOneFolderAreRefused) {
  make_specimen();
  fs::create_directories(folder / "out");
  const int held = ::open((folder / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  const std::vector<std::string> words{"test",   "elastic",   "--specimen", "s1.h5",
                                       "--card", "card.toml", "-o",         "out"};
  EXPECT_THAT(refusal(2, words), HasSubstr("out: another run is at work in this folder"));
  ::close(held);
  EXPECT_EQ(spall(words).code, 0);
}

TEST_F(Streams, AHangUpLeavesACheckpointAndSignalsThatComeTogetherAreOne) {
  make_specimen();
  for (const std::vector<int>& signals : {std::vector{SIGHUP}, {SIGTERM, SIGTERM}, {SIGINT, SIGTERM, SIGHUP}}) {
    fs::remove_all(folder / "out");
    const pid_t child = start(long_test());
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    for (const int signal : signals) {
      ::kill(child, signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const auto outcome = wait_for(child);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(files(), testing::Contains("out/checkpoint.h5"));
  }
}

TEST_F(Streams, AResultOfAFinishedRunIsKnownByAnotherNameOfItsFolder) {
  make_specimen();
  std::vector<std::string> words{"test", "tension",    "--specimen", "s1.h5", "--card", "card.toml", "--frames",
                                 "0",    "--velocity", "0.05 m/s",   "-o",    "out",    "--resume"};
  ASSERT_EQ(spall(words).code, 0);
  words[words.size() - 2] = (folder / "out").string();
  EXPECT_THAT(spall(words).err, HasSubstr("the run is finished and stays as it is"));
}

TEST_F(Streams, FramesOfAnEarlierRunDoNotStayBesideAResultWithoutAny) {
  make_specimen();
  std::vector<std::string> words{"test",     "tension", "--specimen", "s1.h5",    "--card", "card.toml",
                                 "--frames", "2",       "--velocity", "0.05 m/s", "-o",     "out"};
  ASSERT_EQ(spall(words).code, 0);
  ASSERT_TRUE(fs::exists(folder / "out/frames"));
  words[7] = "0";
  ASSERT_EQ(spall(words).code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/frames"));
}
