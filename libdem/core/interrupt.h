// Ctrl-C and SIGTERM set a flag; long loops look at it and stop at a point from which they can go on.
#pragma once
#include <atomic>

namespace dem {

/// Installs handlers for SIGINT and SIGTERM that set the flag, and for SIGHUP and SIGXCPU where they are not
/// ignored. Another signal more than a second later ends the process at once.
void install_interrupt_handlers();
/// True once a signal asked for a stop, or whoever started this thread's job did.
bool interrupt_requested();
/// Sets or clears the flag by hand (for tests, and for embedding).
void set_interrupt(bool requested);

/// Set by whoever started a job to stop that job alone, where several run in one process.
using StopRequest = std::atomic<bool>;

/// While it lives, interrupt_requested() of this thread looks at `request` too (null: at signals alone). A job
/// that hands work to other threads opens one in each of them with its own stop_request().
class StopScope {
 public:
  explicit StopScope(const StopRequest* request);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const StopRequest* before;
};
/// The request that this thread looks at, or null.
const StopRequest* stop_request();

}  // namespace dem
