// Runs the tasks of a plan: those that are missing, each once, side by side on the cores.
#pragma once
#include <string>
#include <vector>

#include "libdem/core/progress.h"
#include "study/folder.h"
#include "study/plan.h"

namespace study {

struct RunOptions {
  int threads = 1;            ///< tasks at a time; a task uses one thread
  double memory = 0;          ///< [bytes] for all tasks at a time; 0: dem::available_memory()
  bool retry_failed = false;  ///< run those again that failed before
};

struct TaskFailure {
  std::size_t task = 0;  ///< index into Plan::tasks
  std::string message;
};

struct RunOutcome {
  std::size_t chosen = 0;             ///< tasks that were asked for
  std::size_t results = 0;            ///< different results that these need
  std::size_t ran = 0;                ///< results made by this run, failures included
  std::vector<TaskFailure> failures;  ///< of the chosen tasks, old and new, in the plan's order
};

/// Runs the tasks `chosen` (indices into plan.tasks) whose results are not in the folder yet, longest first,
/// and returns when every one of them has a result or has failed: tasks that another process works on are
/// waited for, and taken over if that process dies. A task that fails leaves its message, and the others go
/// on.
///
/// Throws InputError if a task cannot fit into options.memory; Interrupted on a signal: tests under way then
/// keep a checkpoint; RunError if the folder cannot be written any more (a full disk). Results that are
/// finished stay whole in each case, and the same call goes on.
RunOutcome run_tasks(const Plan& plan, const std::vector<std::size_t>& chosen, const StudyFolder& folder,
                     const RunOptions& options, const dem::ProgressCallback& progress = {});

}  // namespace study
