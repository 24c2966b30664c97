#include "libdem/core/interrupt.h"

#include <atomic>
#include <csignal>

namespace dem {
namespace {
std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);
thread_local const StopRequest* of_this_thread = nullptr;

void on_signal(int signal) {
  if (requested.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}
}  // namespace

void install_interrupt_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
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
