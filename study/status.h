// How far a study is, from its folder alone.
#pragma once
#include <vector>

#include "study/folder.h"
#include "study/plan.h"

namespace study {

enum class TaskState { done, failed, running, missing };
std::string_view name_of(TaskState state);

struct StudyStatus {
  std::vector<TaskState> states;  ///< of each task; running: some process works on it now
  std::size_t done = 0, failed = 0, running = 0, missing = 0;
  /// What the finished tests took over what they were estimated to take; 1 if none is finished.
  double pace = 1;
  double seconds_left = 0;  ///< on one core, of results that are running or missing, at that pace
};

StudyStatus status_of(const Plan& plan, const StudyFolder& folder);

}  // namespace study
