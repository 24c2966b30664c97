// Runs one of Slurm's commands, without a shell in between, and keeps what it said.
#pragma once
#include <string>
#include <vector>

namespace study {

struct CommandOutcome {
  bool found = true;  ///< false: there is no such command here
  int code = 0;       ///< exit code; 128 + the signal's number if a signal ended it
  std::string out;    ///< standard output
  std::string err;    ///< standard error
};

/// Runs `words` (the first is the command, looked for in PATH; the others its arguments, as they are) with
/// nothing on standard input, and waits. Throws RunError if the system has no room for another process.
CommandOutcome run_command(const std::vector<std::string>& words);

/// Slurm's own words for a failure, on one line: without "sbatch: error: " before them and the hints after.
std::string slurm_message(const CommandOutcome& outcome);

}  // namespace study
