// Runs one task: a specimen, a card, a test.
#pragma once
#include <filesystem>

#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "study/study_file.h"
#include "study/task_result.h"

namespace study {

struct TaskOutcome {
  TaskResult result;
  TaskTime time;
};

/// On one thread. `checkpoint` is where a test that is stopped, or takes minutes, keeps its state, and from
/// where it goes on; it is removed when the test is over. Throws what a test throws.
TaskOutcome run_task(const std::string& key, const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const VirtualTest& test, const std::filesystem::path& checkpoint,
                     const dem::ProgressCallback& progress = {});

}  // namespace study
