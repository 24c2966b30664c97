#include "libdem/core/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "libdem/core/error.h"

namespace dem {
namespace {

void hold_to(const ChildLimits& limits) {
  const auto set = [](auto resource, rlim_t value) {
    const rlimit both{value, value};
    ::setrlimit(resource, &both);
  };
  set(RLIMIT_CORE, 0);
  if (limits.seconds != ChildLimits::none) set(RLIMIT_CPU, limits.seconds);
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const std::uint64_t now = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  if (pages > 0 && limits.memory < ChildLimits::none - now) set(RLIMIT_AS, now + limits.memory);
}

}  // namespace

pid_t start_child(const std::function<void()>& work, const ChildLimits& limits) {
  constexpr int success = 0, failure = 1;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw RunError(std::string("cannot start a process: ") + std::strerror(errno));
  if (child > 0) return child;
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  // Nor does it report a crash, which is what it is there for: sanitizers would, and take half a second.
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(crash, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(failure);  // it ended before it could take the child along
  hold_to(limits);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  try {
    work();
  } catch (...) {
    ::_exit(failure);
  }
  ::_exit(success);
}

ChildEnd wait_for_child(pid_t child) {
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  if (ended == child && WIFSIGNALED(status)) return {false, ::strsignal(WTERMSIG(status))};
  return {ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0, ""};
}

}  // namespace dem
