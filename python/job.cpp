#include "python/job.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "libdem/core/error.h"
#include "python/parts.h"

namespace python {
namespace {

namespace py = pybind11;
constexpr auto between_looks = std::chrono::milliseconds(50);

std::mutex running_mutex;
std::set<Job*>& running() {
  static std::set<Job*> jobs;
  return jobs;
}

int threads_for(int asked) {
  if (asked < 0 || asked > 1024)
    throw dem::InputError("threads", fmt::format("is {}", asked),
                          "allowed: 1 to 1024, or None for as many as OpenMP gives");
  return asked > 0 ? asked : std::max(1, omp_get_max_threads());
}

/// Python's own words about an interrupt get what the work says about going on.
void add_note(const py::object& raised, const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const dem::Interrupted& stop) {
    if (py::hasattr(raised, "add_note")) raised.attr("add_note")(stop.what());
  } catch (...) {  // NOLINT: what was raised first is what counts
  }
}

}  // namespace

Job::Job(py::object progress, int threads) : listener(std::move(progress)), thread_count(threads_for(threads)) {
  if (!listener.is_none() && PyCallable_Check(listener.ptr()) == 0)
    throw py::type_error("progress must be None or callable");
  const std::scoped_lock lock(running_mutex);
  running().insert(this);
}

Job::~Job() {
  const std::scoped_lock lock(running_mutex);
  running().erase(this);
}

dem::ProgressCallback Job::progress() {
  if (listener.is_none()) return {};
  return [this](const dem::Progress& now) {
    const std::scoped_lock lock(mutex);
    if (!news.empty() && news.back().stage == now.stage)
      news.back() = now;
    else
      news.push_back(now);
  };
}

void Job::call_back(const std::function<void()>& action) {
  std::unique_lock lock(mutex);
  if (stop_wanted) return;
  wanted = &action;
  changed.notify_all();
  changed.wait(lock, [this] { return wanted == nullptr; });
}

void Job::serve() {
  std::vector<dem::Progress> heard;
  const std::function<void()>* action = nullptr;
  {
    const std::scoped_lock lock(mutex);
    heard.swap(news);
    action = wanted;
  }
  struct Answer {  // whatever happens: the work must not wait for ever
    Job& job;
    const bool is_due;
    ~Answer() {
      if (!is_due) return;
      const std::scoped_lock lock(job.mutex);
      job.wanted = nullptr;
      job.changed.notify_all();
    }
  } answer{*this, action != nullptr};
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  for (const dem::Progress& progress : heard) listener(progress);
  if (action != nullptr && !stop_wanted) (*action)();
}

void Job::run(const std::function<void()>& work) {
  std::exception_ptr failure;
  std::thread thread([&] {
    const dem::StopScope scope(&stop_wanted);
    omp_set_num_threads(thread_count);
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::scoped_lock lock(mutex);
    over = true;
    changed.notify_all();
  });
  std::exception_ptr raised;
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release released;
      std::unique_lock lock(mutex);
      changed.wait_for(lock, between_looks, [this] { return over || wanted != nullptr; });
      ended = over;
    }
    try {
      serve();
    } catch (...) {
      if (!raised) raised = std::current_exception();
      stop_wanted = true;
    }
  }
  {
    const py::gil_scoped_release released;
    thread.join();
  }
  if (raised) {
    try {
      std::rethrow_exception(raised);
    } catch (const py::error_already_set& error) {
      if (failure) add_note(error.value(), failure);
      throw;
    }
  }
  if (failure) std::rethrow_exception(failure);
}

void add_jobs(py::module_& module) {
  py::class_<dem::Progress>(module, "Progress", "Where a long call stands.")
      .def_readonly("stage", &dem::Progress::stage, "What is being done now, as \"compression, seed 3\".")
      .def_readonly("done", &dem::Progress::done, "How much of it is done, counted in `unit`.")
      .def_readonly("total", &dem::Progress::total, "How much there is; 0 when it is not known.")
      .def_readonly("unit", &dem::Progress::unit, "What is counted: \"steps\", \"virtual tests\", ...")
      .def_readonly("detail", &dem::Progress::detail, "One short remark; may be empty.")
      .def("__repr__", [](const dem::Progress& p) {
        return fmt::format("Progress(stage='{}', done={:g}, total={:g}, unit='{}', detail='{}')", p.stage,
                           p.done, p.total, p.unit, p.detail);
      });
  module.def(
      "stop_runs",
      [] {
        const std::scoped_lock lock(running_mutex);
        for (Job* job : running()) job->stop();
        return running().size();
      },
      "Ask every run of this process, in whatever thread, to stop: each raises KeyboardInterrupt in its own "
      "thread,\n"
      "after it has kept its state where it was asked to. Returns how many runs were asked.");
}

}  // namespace python
