// Submitting a study's missing tasks to Slurm, keeping track of what was submitted, and what came of it.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "study/slurm.h"
#include "study/slurm_queue.h"
#include "study/status.h"

namespace study {

/// One job array that was submitted. Its elements' indices count from 0, in the order of `chunks`.
struct Submission {
  JobName job;
  std::string submitted;              ///< ISO 8601, UTC
  std::string plan;                   ///< names the plan whose tasks the numbers are; see `SlurmRequest`
  std::filesystem::path script;       ///< what sbatch was given
  double time_limit = 0, memory = 0;  ///< of one element [s], [bytes]
  std::vector<std::vector<std::size_t>> chunks;
};

/// The study folder's slurm.json; none if there is no such file. Throws InputError if it is not one of ours.
std::vector<Submission> read_submissions(const std::filesystem::path& folder);
/// Writes it whole. Throws RunError.
void write_submissions(const std::filesystem::path& folder, const std::vector<Submission>& submissions);

/// One element of one submission: what Slurm says beside the results that are there.
struct ElementStatus {
  JobName job;
  std::size_t index = 0;
  std::vector<std::size_t> tasks;
  ElementState slurm;  ///< an element that Slurm has forgotten, with all its results: finished
  std::size_t done = 0, failed = 0, missing = 0;  ///< of its tasks, now; one that runs is missing
  bool other_plan = false;  ///< submitted for another version of the study: its results are not counted
};

/// `tasks` is the state of task 1, 2, ... of the plan called `plan`.
std::vector<ElementStatus> element_states(const std::vector<Submission>& submissions, const QueueAnswer& answer,
                                          const std::vector<TaskState>& tasks, const std::string& plan);

struct SlurmStatus {
  std::vector<ElementStatus> elements;
  std::string no_accounting;  ///< why sacct did not answer; empty if it did, or nobody asked
};
/// Asks Slurm about everything that was submitted from this folder; asks nothing if nothing was. Throws what
/// `read_submissions` and `ask_slurm` throw.
SlurmStatus slurm_status(const std::filesystem::path& folder, const std::vector<TaskState>& tasks,
                         const std::string& plan);

struct SlurmRequest {
  SlurmPlace place;  ///< `output` is the study's folder; `logs` is set here
  SlurmOptions options;
  std::vector<SlurmTask> tasks;   ///< those that are to run
  std::vector<TaskState> states;  ///< of every task of the plan
  std::string plan;               ///< changes with the meaning of the tasks' numbers
  std::string now;                ///< ISO 8601, UTC
};

struct Submitted {
  std::vector<Submission> arrays;      ///< new ones; more than one only if the cluster's arrays are short
  std::vector<std::size_t> in_flight;  ///< asked for, but left out: a job is at them already
};

/// Submits what is asked for and not in flight; every array is in slurm.json before the next is submitted. Two
/// of these at once on one folder take turns.
///
/// Throws InputError if sbatch refuses, with Slurm's message; RunError if Slurm is not there or does not
/// answer, if all tasks are in flight, or if an array of another version of the study still is.
Submitted submit(const SlurmRequest& request);

}  // namespace study
