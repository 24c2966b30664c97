// Wrong inputs as people really give them: bad_input/*.toml. Each is refused by the real command: exit code 2,
// one line on standard error that says where, what and how to put it right, and nothing written.
#include <atomic>
#include <iostream>
#include <map>
#include <mutex>
#include <thread>

#include "calibrate/calibration_case.h"
#include "impact/scene_file.h"
#include "libdem/material/material_card.h"
#include "study/plan.h"
#include "study/study_file.h"
#include "tests/cli/bad_input_table.h"
#include "tests/cli/command.h"

namespace {

namespace fs = std::filesystem;
using cli::WrongInput;

const fs::path tables = fs::path(SPALL_SOURCE_DIR) / "tests/cli/bad_input";

/// Every file with its content, and every folder.
std::map<std::string, std::string> content_below(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    content[fs::relative(entry.path(), folder).string()] =
        entry.is_directory() ? "a folder" : "a file: " + cli::content_of(entry.path());
  return content;
}

class BadInput : public cli::Command {
 protected:
  /// Runs the row's command in its own folder, and says what is not as it should be: "" if nothing.
  std::string tried(const WrongInput& row, std::size_t number) const {
    const fs::path own = folder / std::to_string(number), said = folder / (std::to_string(number) + ".said");
    fs::create_directories(own);
    fs::create_directories(said);
    cli::place(row, tables / "base", own);
    const auto before = content_below(own);
    std::vector<std::string> words{"env", "-C", own.string(), "timeout", "-s", "KILL", "20", SPALL_BINARY};
    words.insert(words.end(), row.command.begin(), row.command.end());
    const cli::Outcome found = run(words, said);
    std::string wrong;
    const auto note = [&](const std::string& what) { wrong += "\n  " + what; };
    if (found.code != 2) note("exit code " + std::to_string(found.code));
    if (!found.out.empty()) note("on standard output: " + found.out);
    if (!cli::matches(found.err, row.line + "\n")) note("expected: " + row.line + "\n  said:     " + found.err);
    if (found.err.size() > 600) note("a line of " + std::to_string(found.err.size()) + " letters");
    if (content_below(own) != before) note("something was written");
    fs::remove_all(own);
    return wrong;
  }

 private:
  static cli::Outcome run(std::vector<std::string>& words, const fs::path& said) {
    std::vector<char*> values;
    for (std::string& word : words) values.push_back(word.data());
    values.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string out = said / "out", err = said / "err";
    const int flags = O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags & ~O_CLOEXEC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags & ~O_CLOEXEC, 0600);
    pid_t child = -1;
    int status = 0;
    const int failed = posix_spawnp(&child, "env", &actions, nullptr, values.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0 || ::waitpid(child, &status, 0) != child) return {};
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, cli::content_of(out), cli::content_of(err)};
  }
};

}  // namespace

TEST_F(BadInput, EveryRowOfTheTablesIsRefusedWithItsLine) {
  const std::vector<WrongInput> rows = cli::read_wrong_inputs(tables);
  ASSERT_GE(rows.size(), 150U);
  std::atomic<std::size_t> next{0}, refused{0};
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k; (k = next++) < rows.size();) {
      std::string wrong;
      try {
        wrong = tried(rows[k], k);
      } catch (const std::exception& error) {
        wrong = std::string("\n  the row cannot be tried: ") + error.what();
      }
      if (wrong.empty()) {
        ++refused;
        continue;
      }
      const std::lock_guard guard(printing);
      ADD_FAILURE() << rows[k].name << wrong;
    }
  };
  std::vector<std::thread> workers;
  for (unsigned k = 0; k < 2; ++k) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  std::cout << refused << " wrong inputs refused, of " << rows.size() << "\n";
}

TEST_F(BadInput, OfATableIsMadeFromFilesThatAreRight) {
  const fs::path base = tables / "base";
  EXPECT_NO_THROW(dem::read_card(base / "card.toml"));
  for (const char* name : {"case.toml", "lab.toml"}) EXPECT_NO_THROW(calibrate::read_case(base / name)) << name;
  for (const char* name : {"slab.toml", "coupled.toml", "stl.toml"})
    EXPECT_NO_THROW(impact::read_scene(base / name, std::nullopt)) << name;
  for (const char* name : {"study.toml", "sobol.toml"})
    EXPECT_NO_THROW(study::make_plan(study::read_study(base / name))) << name;
}

TEST_F(BadInput, PatternsMatchWholeLinesOnly) {
  EXPECT_TRUE(cli::matches("a: b; c", "a: b; c"));
  EXPECT_TRUE(cli::matches("a: b; c", "a: <any>; c"));
  EXPECT_TRUE(cli::matches("a: b; c", "<any>c"));
  EXPECT_FALSE(cli::matches("a: b; c", "a: b"));
  EXPECT_FALSE(cli::matches("a: b; c", "<any>; d"));
}

// The input is right there, the place for what comes out is not: that is exit code 1.
TEST_F(BadInput, AnOutputThatCannotBeWrittenIsExitCode1) {
  for (const char* name : {"case.toml", "card.toml"}) fs::copy(tables / "base" / name, folder / name);
  for (const std::string output : {"card.toml", "card.toml/out", "/proc/out"})
    EXPECT_THAT(refusal(1, {"calibrate", "case.toml", "-o", output}), testing::HasSubstr(output));
}
