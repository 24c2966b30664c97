#include "libdem/core/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace dem {
namespace {
std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);
thread_local const StopRequest* of_this_thread = nullptr;

std::atomic<std::int64_t> first_at{0};  // [ms]
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t milliseconds_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000;
}

// A second signal ends the process at once, unless it comes with the first: some send theirs to a process and
// to its group.
void on_signal(int signal) {
  constexpr std::int64_t together = 1000;
  const std::int64_t now = milliseconds_now();
  if (!requested.exchange(true)) {
    first_at = now;
  } else if (now - first_at >= together) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

void listen_unless_ignored(int signal) {
  if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);  // nohup
}
}  // namespace

void install_interrupt_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  listen_unless_ignored(SIGHUP);
  listen_unless_ignored(SIGXCPU);
}
bool interrupt_requested() {
  return requested.load(std::memory_order_relaxed) ||
         (of_this_thread != nullptr && of_this_thread->load(std::memory_order_relaxed));
}
void set_interrupt(bool value) { requested = value; }

StopScope::StopScope(const StopRequest* request) : before(of_this_thread) { of_this_thread = request; }
StopScope::~StopScope() { of_this_thread = before; }
const StopRequest* stop_request() { return of_this_thread; }

}  // namespace dem
