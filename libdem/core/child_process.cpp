#include "libdem/core/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "libdem/core/error.h"

namespace dem {

pid_t start_child(const std::function<void()>& work) {
  constexpr int success = 0, failure = 1;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw RunError(std::string("cannot start a process: ") + std::strerror(errno));
  if (child > 0) return child;
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(failure);  // it ended before it could take the child along
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
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
