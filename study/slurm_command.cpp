#include "study/slurm_command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <regex>
#include <sstream>
#include <system_error>

#include "libdem/core/error.h"

namespace study {
namespace {

[[noreturn]] void cannot_run(const std::string& command, int reason) {
  throw dem::RunError(command + ": cannot be run: " + std::generic_category().message(reason));
}

/// Both ends of a pipe, closed at the end; not inherited unless handed over.
struct Pipe {
  std::array<int, 2> ends{-1, -1};

  explicit Pipe(const std::string& command) {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) cannot_run(command, errno);
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_writing_end() {
    ::close(ends[1]);
    ends[1] = -1;
  }
};

/// Reads both until both end. Taken in turns, lest the command waits for one while this waits for the other.
void read_both(const Pipe& out, const Pipe& err, CommandOutcome& outcome) {
  std::array<pollfd, 2> sources{pollfd{out.ends[0], POLLIN, 0}, pollfd{err.ends[0], POLLIN, 0}};
  const std::array<std::string*, 2> texts{&outcome.out, &outcome.err};
  std::array<char, 4096> buffer;
  while (sources[0].fd >= 0 || sources[1].fd >= 0) {
    if (::poll(sources.data(), sources.size(), -1) < 0) {
      if (errno == EINTR) continue;
      break;
    }
    for (std::size_t k = 0; k < sources.size(); ++k) {
      if (sources[k].fd < 0 || sources[k].revents == 0) continue;
      const ssize_t count = ::read(sources[k].fd, buffer.data(), buffer.size());
      if (count > 0)
        texts[k]->append(buffer.data(), static_cast<std::size_t>(count));
      else if (count == 0 || errno != EINTR)
        sources[k].fd = -1;
    }
  }
}

}  // namespace

CommandOutcome run_command(const std::vector<std::string>& words) {
  Pipe out(words.front()), err(words.front());
  std::vector<std::string> arguments = words;
  std::vector<char*> pointers;
  for (std::string& word : arguments) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
  pid_t child = -1;
  const int reason = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);

  CommandOutcome outcome;
  if (reason == ENOENT || reason == EACCES || reason == ENOTDIR) {
    outcome.found = false;
    return outcome;
  }
  if (reason != 0) cannot_run(words.front(), reason);
  out.close_writing_end();
  err.close_writing_end();
  read_both(out, err, outcome);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) cannot_run(words.front(), errno);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

std::string slurm_message(const CommandOutcome& outcome) {
  static const std::regex prefix(R"(^\w+: (error|fatal|warning): |^s[a-z]+: |^slurm_load_\w+ error: )");
  std::istringstream lines(outcome.err.empty() ? outcome.out : outcome.err);
  std::string message;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    line = std::regex_replace(line, prefix, "");
    if (line.empty() || line.starts_with("Try \"")) continue;
    message += (message.empty() ? "" : "; ") + line;
  }
  return message.empty() ? "exit code " + std::to_string(outcome.code) : message;
}

}  // namespace study
