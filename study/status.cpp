#include "study/status.h"

#include <map>

namespace study {

std::string_view name_of(TaskState state) {
  switch (state) {
    case TaskState::done:
      return "done";
    case TaskState::failed:
      return "failed";
    case TaskState::running:
      return "running";
    case TaskState::missing:
      break;
  }
  return "missing";
}

StudyStatus status_of(const Plan& plan, const StudyFolder& folder) {
  StudyStatus status;
  std::map<std::string, TaskState> known;  // tasks may share a result
  double took = 0, estimated = 0, left = 0;
  for (const Task& task : plan.tasks) {
    auto found = known.find(task.key);
    if (found == known.end()) {
      const TaskState state = folder.has_result(task.key)               ? TaskState::done
                              : Claims::held(folder.claims(), task.key) ? TaskState::running
                              : folder.has_failure(task.key)            ? TaskState::failed
                                                                        : TaskState::missing;
      found = known.emplace(task.key, state).first;
      if (state == TaskState::done) {
        if (const auto time = folder.read_time(task.key)) took += time->wall_seconds, estimated += task.seconds;
      } else if (state != TaskState::failed) {
        left += task.seconds;
      }
    }
    status.states.push_back(found->second);
    switch (found->second) {
      case TaskState::done:
        ++status.done;
        break;
      case TaskState::failed:
        ++status.failed;
        break;
      case TaskState::running:
        ++status.running;
        break;
      case TaskState::missing:
        ++status.missing;
        break;
    }
  }
  if (took > 0 && estimated > 0) status.pace = took / estimated;
  status.seconds_left = left * status.pace;
  return status;
}

}  // namespace study
