// Runs the real `spall` binary in a folder of its own and keeps what it said.
#pragma once
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace cli {

struct Outcome {
  int code = -1;    ///< exit code; 128 + the signal's number if a signal ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A fixture with an empty folder, removed at the end, in which the commands run.
class Command : public testing::Test {
 protected:
  std::filesystem::path folder;

  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    // A parameterised test's name has a '/' in it.
    std::string name =
        std::string(info->test_suite_name()) + "." + info->name() + "." + std::to_string(::getpid());
    std::replace(name.begin(), name.end(), '/', '.');
    folder = std::filesystem::temp_directory_path() / ("spall-cli-" + name);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Starts `program` without waiting for it; its output goes to files in a hidden folder.
  pid_t start_program(const std::string& program, const std::vector<std::string>& arguments) const {
    const auto aside = folder / ".said";
    std::filesystem::create_directories(aside);
    // The shell of posix_spawn has no working folder (before glibc 2.29), so `env -C` changes it.
    std::vector<std::string> words{"env", "-C", folder.string(), program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> values;
    for (std::string& word : words) values.push_back(word.data());
    values.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    const int flags = O_CREAT | O_WRONLY | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (aside / "out").c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (aside / "err").c_str(), flags, 0600);
    pid_t child = -1;
    EXPECT_EQ(posix_spawnp(&child, "env", &actions, nullptr, values.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    return child;
  }

  pid_t start(const std::vector<std::string>& arguments) const {
    return start_program(SPALL_BINARY, arguments);
  }

  Outcome wait_for(pid_t child) const {
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const auto aside = folder / ".said";
    Outcome outcome{code, content_of(aside / "out"), content_of(aside / "err")};
    std::filesystem::remove_all(aside);
    return outcome;
  }

  Outcome spall(const std::vector<std::string>& arguments) const { return wait_for(start(arguments)); }

  Outcome shell(const std::string& command) const { return wait_for(start_program("sh", {"-c", command})); }

  /// Runs it and expects this exit code, nothing on standard output, and one line on standard error, which is
  /// returned.
  std::string refusal(int code, const std::vector<std::string>& arguments) const {
    const std::set<std::string> before = files();
    const Outcome outcome = spall(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("spall"));
    EXPECT_EQ(files(), before) << "something was written";
    return outcome.err;
  }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
    return name;
  }
  std::string read(const std::string& name) const { return content_of(folder / name); }

  /// Every file and folder below the test's own.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      names.insert(std::filesystem::relative(entry.path(), folder).string());
    return names;
  }
};

/// A card that is right, to be spoilt by tests.
inline const std::string good_card = R"(E = "30 GPa"
nu = 0.2
T = "3.1 MPa"
Co = "36 MPa"
zeta = 5
phi_i = "6 degree"
phi_c = "6 degree"
alpha = 3.7
beta = 2.198
gamma = 3.79
)";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

}  // namespace cli
