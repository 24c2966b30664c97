// Which task comes next: the longest that may run now.
#pragma once
#include <chrono>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace study {

/// One result to be made. Tasks that share a result stand here once.
struct Job {
  enum class State { waiting, running, elsewhere, done, failed };
  std::size_t task = 0;      ///< index into Plan::tasks
  std::size_t specimen = 0;  ///< index into Study::specimens
  std::string key;
  double seconds = 0, bytes = 0;
  State state = State::waiting;
  std::chrono::steady_clock::time_point look_again{};  ///< elsewhere: when to look whether it is done
};

/// Not locked: its user does that.
class TaskQueue {
 public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Longest first; of equals the plan's order. `memory` in bytes.
  TaskQueue(std::vector<Job> jobs, std::size_t specimens, double memory);

  /// Index of the job to run now, marked as running, or `none`. A job waits while another thread is getting
  /// its specimen, and while it does not fit into memory beside those that run.
  std::size_t take(std::chrono::steady_clock::time_point now);
  /// The specimen of the job is at hand: others that need it may go.
  void specimen_ready(std::size_t job);
  void finish(std::size_t job, bool failed);
  /// Another process has it, or its specimen, in hand.
  void put_off(std::size_t job, std::chrono::steady_clock::time_point until);

  bool all_done() const { return open == 0; }
  const Job& operator[](std::size_t job) const { return jobs[job]; }
  const std::vector<Job>& all() const { return jobs; }

 private:
  enum class SpecimenState : char { unknown, in_hand, ready };
  void stop_running(std::size_t job);

  std::vector<Job> jobs;
  std::vector<SpecimenState> specimens;
  double memory, in_use = 0;
  std::size_t running = 0, open = 0;
  std::size_t first = 0;  // all jobs before it are over
};

}  // namespace study
