#include "study/runner.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/memory.h"
#include "libdem/run/checkpoint_interval.h"
#include "study/plan_key.h"
#include "study/specimen_store.h"
#include "study/task_queue.h"
#include "study/task_run.h"

namespace study {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_looks = std::chrono::milliseconds(250);  // at what other processes do
constexpr auto between_reports = std::chrono::milliseconds(100);

/// Thrown out of a test that is to be given up because the run as a whole cannot go on.
struct GivenUp {};

std::vector<Job> jobs_of(const Plan& plan, const std::vector<std::size_t>& chosen) {
  std::vector<Job> jobs;
  std::map<std::string, bool> known;
  for (const std::size_t index : chosen) {
    const Task& task = plan.tasks[index];
    if (known.emplace(task.key, true).second)
      jobs.push_back({index, task.specimen, task.key, task.seconds, task.bytes, {}, {}});
  }
  return jobs;
}

void require_to_fit(const Plan& plan, const std::vector<Job>& jobs, double memory, bool asked) {
  for (const Job& job : jobs)
    if (job.bytes > memory) {
      const std::string what = fmt::format(
          "task {} ({}) needs about {:.2g} GB, and {:.2g} GB are to be used", plan.tasks[job.task].number,
          label_of(plan.specimen_of(plan.tasks[job.task])), job.bytes / 1e9, memory / 1e9);
      if (asked) throw dem::InputError("--memory", what, "allow more, or choose other tasks");
      throw dem::RunError(what + "; free memory, choose other tasks, or allow more with --memory");
    }
}

/// One run: what its threads share.
class Run {
 public:
  Run(const Plan& whole, std::vector<Job> jobs, const StudyFolder& where, Claims& held, const RunOptions& how,
      double memory)
      : plan(whole),
        folder(where),
        claims(held),
        options(how),
        specimens(where, held),
        queue(std::move(jobs), whole.study.specimens.size(), memory),
        parts(queue.all().size()) {
    for (const Job& job : queue.all()) total_seconds += job.seconds;
  }

  void go(const dem::ProgressCallback& progress);
  std::size_t jobs_run() const { return ran; }

 private:
  /// Throws RunError if the machine gives no more threads; those that it gave are in `workers`.
  void start(std::vector<std::thread>& workers);
  /// Until all is done, or something ends the run.
  void watch(const dem::ProgressCallback& progress);
  void work();
  void do_job(std::size_t index);
  /// Done, failed, or not at all: settles the job if nothing needs to be run. True if it is settled.
  bool settled(std::size_t index);
  void run_claimed(std::size_t index);
  void finish(std::size_t index, bool failed);
  void put_off(std::size_t index);
  void stop_for(std::exception_ptr reason);
  bool must_stop() const { return stopping.load() || dem::interrupt_requested(); }
  dem::Progress where_it_stands();

  const Plan& plan;
  const StudyFolder& folder;
  Claims& claims;
  const RunOptions& options;
  SpecimenStore specimens;

  std::mutex mutex;  // of all below
  std::condition_variable changed;
  TaskQueue queue;
  std::size_t ran = 0, failed = 0;
  double done_seconds = 0;
  std::exception_ptr fatal;

  const dem::StopRequest* const stop = dem::stop_request();  // of the thread that called
  std::vector<std::atomic<float>> parts;                     // of each job that is done, for the progress
  std::atomic<bool> stopping{false};
  double total_seconds = 0;
};

void Run::go(const dem::ProgressCallback& progress) {
  std::vector<std::thread> workers;
  try {
    start(workers);
    watch(progress);
  } catch (...) {
    stop_for(std::current_exception());  // whatever went wrong here: threads must end before their study does
  }
  changed.notify_all();
  for (std::thread& worker : workers) worker.join();
  if (fatal) std::rethrow_exception(fatal);
  if (!queue.all_done()) throw dem::Interrupted("stopped by a signal");
}

void Run::start(std::vector<std::thread>& workers) {
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(options.threads), queue.all().size());
  workers.reserve(count);
  try {
    while (workers.size() < count) workers.emplace_back([this] { work(); });
  } catch (const std::system_error& error) {
    throw dem::RunError(
        fmt::format("{} of {} threads can be started: {}; give fewer with --threads, or look at the limits "
                    "that ulimit -v and ulimit -u print",
                    workers.size(), count, error.code().message()));
  }
}

void Run::watch(const dem::ProgressCallback& progress) {
  std::unique_lock lock(mutex);
  while (!queue.all_done() && !must_stop()) {
    changed.wait_for(lock, between_reports);
    if (!progress) continue;
    const dem::Progress now = where_it_stands();
    lock.unlock();
    progress(now);
    lock.lock();
  }
  stopping = stopping || dem::interrupt_requested();
}

dem::Progress Run::where_it_stands() {
  double seconds = done_seconds;
  std::size_t over = 0;
  std::string detail;
  for (std::size_t k = 0; k < queue.all().size(); ++k) {
    const Job& job = queue[k];
    if (job.state == Job::State::done || job.state == Job::State::failed) ++over;
    if (job.state != Job::State::running) continue;
    seconds += job.seconds * static_cast<double>(parts[k].load(std::memory_order_relaxed));
    if (detail.empty()) {
      const Task& task = plan.tasks[job.task];
      detail = fmt::format("{}: {}", label_of(plan.specimen_of(task)), plan.test_of(task).name);
    }
  }
  if (failed > 0) detail = fmt::format("{} failed; {}", failed, detail);
  // Weighed by the estimates, so that the time left is not taken from the number of tasks, long and short
  // alike.
  const auto count = static_cast<double>(queue.all().size());
  const bool all = over == queue.all().size();
  const double done = all ? count : std::min(count * seconds / std::max(total_seconds, 1e-300), count);
  return {"study", done, count, "results", detail};
}

void Run::work() {
  const dem::StopScope scope(stop);
  omp_set_num_threads(1);  // of this thread: the cores are for tasks
  std::unique_lock lock(mutex);
  while (!queue.all_done() && !must_stop()) {
    const std::size_t index = queue.take(Clock::now());
    if (index == TaskQueue::none) {
      changed.wait_for(lock, between_looks);
      continue;
    }
    lock.unlock();
    do_job(index);
    changed.notify_all();
    lock.lock();
  }
}

void Run::do_job(std::size_t index) {
  try {
    const std::string& key = queue[index].key;
    if (settled(index)) return;
    if (!claims.take(key)) return put_off(index);
    struct Claim {
      Claims& claims;
      const std::string& key;
      ~Claim() { claims.release(key); }
    } claim{claims, key};
    if (settled(index)) return;  // another process was quicker
    run_claimed(index);
  } catch (const GivenUp&) {
    put_off(index);
  } catch (const dem::Interrupted&) {
    put_off(index);
  } catch (...) {
    stop_for(std::current_exception());
    put_off(index);
  }
}

bool Run::settled(std::size_t index) {
  const std::string& key = queue[index].key;
  if (folder.has_result(key)) {
    finish(index, false);
    return true;
  }
  if (!folder.has_failure(key)) return false;
  finish(index, true);
  return true;
}

void Run::run_claimed(std::size_t index) {
  const Job& job = queue[index];
  const Task& task = plan.tasks[job.task];
  std::optional<TaskOutcome> outcome;
  std::string message;
  try {
    const auto specimen = specimens.get(plan.specimen_of(task));
    if (!specimen) return put_off(index);
    {
      const std::scoped_lock lock(mutex);
      queue.specimen_ready(index);
    }
    changed.notify_all();
    const auto follow = [&](const dem::Progress& progress) {
      if (stopping.load(std::memory_order_relaxed)) throw GivenUp{};
      if (progress.total > 0)
        parts[index].store(static_cast<float>(progress.done / progress.total), std::memory_order_relaxed);
    };
    outcome = run_task(job.key, *specimen, plan.card_of(task), plan.test_of(task), folder.checkpoint(job.key),
                       follow);
  } catch (const dem::Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // what the machine lacks now is not the task's failure
  } catch (const std::exception& error) {
    message = error.what();
  }
  if (!outcome && must_stop()) throw GivenUp{};
  if (outcome) {
    folder.write_time(job.key, outcome->time);
    folder.write_result(job.key, outcome->result);
  } else {
    // A folder that cannot be written (a full disk) is not the task's failure: it ends the run.
    if (folder.concerns(message)) throw dem::RunError(message);
    folder.require_space();
    folder.write_failure(job.key, message);
  }
  {
    const std::scoped_lock lock(mutex);
    ++ran;
  }
  finish(index, !outcome);
}

void Run::finish(std::size_t index, bool as_failed) {
  const std::scoped_lock lock(mutex);
  queue.finish(index, as_failed);
  done_seconds += queue[index].seconds;
  if (as_failed) ++failed;
}

void Run::put_off(std::size_t index) {
  const std::scoped_lock lock(mutex);
  queue.put_off(index, Clock::now() + between_looks);
}

void Run::stop_for(std::exception_ptr reason) {
  const std::scoped_lock lock(mutex);
  if (!fatal) fatal = reason;
  stopping = true;
}

std::size_t run_missing(const Plan& plan, std::vector<Job> missing, const StudyFolder& folder,
                        const RunOptions& options, double memory, const dem::ProgressCallback& progress) {
  folder.make();
  Claims claims(folder.claims());
  folder.sweep(claims);
  for (const Job& job : missing)
    if (folder.has_failure(job.key)) folder.forget_failure(job.key);
  Run run(plan, std::move(missing), folder, claims, options, memory);
  run.go(progress);
  return run.jobs_run();
}

}  // namespace

RunOutcome run_tasks(const Plan& plan, const std::vector<std::size_t>& chosen, const StudyFolder& folder,
                     const RunOptions& options, const dem::ProgressCallback& progress) {
  dem::seconds_between_checkpoints(0);  // a wrong environment is refused here, not by every task
  const double memory = options.memory > 0 ? options.memory : dem::available_memory();
  std::vector<Job> jobs = jobs_of(plan, chosen);
  RunOutcome outcome;
  outcome.chosen = chosen.size();
  outcome.results = jobs.size();

  std::vector<Job> missing;
  for (const Job& job : jobs)
    if (!folder.has_result(job.key) && (options.retry_failed || !folder.has_failure(job.key)))
      missing.push_back(job);
  require_to_fit(plan, missing, memory, options.memory > 0);
  if (!missing.empty()) outcome.ran = run_missing(plan, std::move(missing), folder, options, memory, progress);
  for (const std::size_t index : chosen) {
    const std::string& key = plan.tasks[index].key;
    if (!folder.has_result(key) && folder.has_failure(key))
      outcome.failures.push_back({index, folder.read_failure(key)});
  }
  return outcome;
}

}  // namespace study
