#include "app/short_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "app/command.h"

namespace app {
namespace {

std::terminate_handler usual_end = nullptr;

/// Asks for no memory, and for no lock that another thread may hold.
[[noreturn]] void end_at_once() {
  try {
    // Unlike rethrow_exception() it takes no memory. In a handler of terminate() there is one to throw.
    if (std::current_exception()) throw;  // cppcheck-suppress rethrowNoCurrentException
  } catch (const std::bad_alloc&) {
    static std::atomic_flag told;
    while (told.test_and_set()) pause();  // another thread says it, and ends this one too
    [[maybe_unused]] const auto written = write(STDERR_FILENO, out_of_memory, std::strlen(out_of_memory));
    _exit(run_failed);
  } catch (...) {
  }
  if (usual_end != nullptr) usual_end();
  std::abort();
}

}  // namespace

void begin_again_where_address_space_is_limited(char** arguments) {
  constexpr char threads[] = "OPENBLAS_NUM_THREADS";
  rlimit space{};
  if (std::getenv(threads) != nullptr || getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY)
    return;
  if (setenv(threads, "1", 0) == 0) execv("/proc/self/exe", arguments);
}

void say_where_memory_lacked() { usual_end = std::set_terminate(end_at_once); }

}  // namespace app
