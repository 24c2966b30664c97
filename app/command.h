// What every verb of the command line shares: its options, its place in --help, and how its failures are told.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libdem/core/error.h"

namespace app {

/// Exit codes of the command; scripts rely on them.
enum ExitCode : int { done = 0, run_failed = 1, input_wrong = 2, stopped = 3, tolerance_missed = 4 };

/// The options that every verb has.
struct CommonOptions {
  int threads = 0;  ///< 0: OMP_NUM_THREADS, or one a core
  bool json = false;
  bool quiet = false;
  /// The number of threads that a run will use.
  int thread_count() const;
};

/// One call of the command: what was typed, when, and what is to be done.
struct Invocation {
  std::vector<std::string> arguments;  ///< with the program's name
  std::string started;                 ///< ISO 8601, UTC
  std::function<int()> action;         ///< set by the verb that was chosen; returns the exit code
};

/// Adds the verb `name` below `parent`, with the common options and an example (one command a line) under its
/// help.
CLI::App* add_verb(CLI::App& parent, const std::string& name, const std::string& description,
                   const std::string& example, CommonOptions& common);

/// Sets the number of threads of the run.
void use_threads(const CommonOptions& common);

/// Refuses numbers outside [low, high], and NaN (which CLI::Range lets pass).
CLI::Validator number_between(double low, double high);

/// The single line for a command line that CLI11 refused: names the verb and suggests the nearest word.
std::string explain(const CLI::App& root, const CLI::ParseError& error,
                    const std::vector<std::string>& arguments);

/// A path for -o: the file itself must not be a folder, nor, if a library writes it, a device or a pipe, and
/// its folder must be writable. Throws RunError. Call it before any computing.
void require_writable_file(const std::string& file, bool by_a_library = false);

/// What a room below refuses gets the option in front from which it came.
template <class Action>
auto told_about(const std::string& option, Action&& action) {
  try {
    return action();
  } catch (const dem::InputError& error) {
    throw dem::InputError(option, error.what(), "");
  }
}

}  // namespace app
