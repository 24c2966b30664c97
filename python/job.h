// Long calls: the work goes on a thread of its own without Python's lock, while the thread that called it
// passes progress on, looks for signals, and stops the work if either raises.
#pragma once
#include <pybind11/pybind11.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <type_traits>
#include <vector>

#include "libdem/core/interrupt.h"
#include "libdem/core/progress.h"

namespace python {

/// One long call. Callbacks run on the caller's thread: a notebook's display and a matplotlib figure belong to
/// it.
class Job {
 public:
  /// `progress`: None, or called with each Progress. `threads`: 0 for as many as OpenMP gives.
  Job(pybind11::object progress, int threads);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  int threads() const { return thread_count; }
  /// To hand to the work. Keeps the newest of each stage until the caller's thread passes it on, so the work
  /// never waits for Python. Empty if nobody wants to know.
  dem::ProgressCallback progress();
  /// From the work: runs `action` on the caller's thread, with Python's lock, and waits for it. Nothing happens
  /// once the work is to stop.
  void call_back(const std::function<void()>& action);
  /// Asks the work to stop; it throws dem::Interrupted as soon as it can.
  void stop() { stop_wanted = true; }

  /// Call it with Python's lock. Throws what the work throws; what a signal or a callback raised wins over
  /// that.
  void run(const std::function<void()>& work);

 private:
  void serve();  ///< with Python's lock: signals, progress, a callback that waits

  pybind11::object listener;
  int thread_count;
  dem::StopRequest stop_wanted{false};

  std::mutex mutex;  // of all below
  std::condition_variable changed;
  std::vector<dem::Progress> news;
  const std::function<void()>* wanted = nullptr;
  bool over = false;
};

/// run_job(progress, threads, [&](Job& job) { return work; })
template <class Work>
auto run_job(pybind11::object progress, int threads, Work&& work) {
  Job job(std::move(progress), threads);
  using Result = std::invoke_result_t<Work&, Job&>;
  if constexpr (std::is_void_v<Result>) {
    job.run([&] { work(job); });
  } else {
    std::shared_ptr<Result> result;
    job.run([&] { result = std::make_shared<Result>(work(job)); });
    return result;
  }
}

}  // namespace python
