#include "study/task_queue.h"

#include <algorithm>

namespace study {

TaskQueue::TaskQueue(std::vector<Job> wanted, std::size_t specimen_count, double budget)
    : jobs(std::move(wanted)), specimens(specimen_count, SpecimenState::unknown), memory(budget) {
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.seconds > b.seconds; });
  open = jobs.size();
}

std::size_t TaskQueue::take(std::chrono::steady_clock::time_point now) {
  const auto over = [](const Job& job) {
    return job.state == Job::State::done || job.state == Job::State::failed;
  };
  while (first < jobs.size() && over(jobs[first])) ++first;
  for (std::size_t k = first; k < jobs.size(); ++k) {
    Job& job = jobs[k];
    const bool due =
        job.state == Job::State::waiting || (job.state == Job::State::elsewhere && job.look_again <= now);
    if (!due || specimens[job.specimen] == SpecimenState::in_hand) continue;
    if (running > 0 && in_use + job.bytes > memory) continue;
    job.state = Job::State::running;
    ++running;
    in_use += job.bytes;
    if (specimens[job.specimen] == SpecimenState::unknown) specimens[job.specimen] = SpecimenState::in_hand;
    return k;
  }
  return none;
}

void TaskQueue::specimen_ready(std::size_t job) { specimens[jobs[job].specimen] = SpecimenState::ready; }

void TaskQueue::stop_running(std::size_t job) {
  --running;
  in_use -= jobs[job].bytes;
  SpecimenState& state = specimens[jobs[job].specimen];
  if (state == SpecimenState::in_hand) state = SpecimenState::unknown;
}

void TaskQueue::finish(std::size_t job, bool failed) {
  stop_running(job);
  jobs[job].state = failed ? Job::State::failed : Job::State::done;
  --open;
}

void TaskQueue::put_off(std::size_t job, std::chrono::steady_clock::time_point until) {
  stop_running(job);
  jobs[job].state = Job::State::elsewhere;
  jobs[job].look_again = until;
}

}  // namespace study
