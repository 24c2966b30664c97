#include "study/task_run.h"

#include <unistd.h>

#include <system_error>

#include "libdem/core/error.h"
#include "libdem/run/checkpoint_interval.h"
#include "specimens/virtual_tests/catalogue.h"

namespace study {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

virtual_tests::TestOutcome go_on_or_anew(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                         const virtual_tests::TestOptions& options, const fs::path& checkpoint,
                                         const dem::ProgressCallback& progress) {
  const double seconds_between = dem::seconds_between_checkpoints(120);
  if (fs::exists(checkpoint)) {
    try {
      return virtual_tests::run_test(specimen, card, options, progress,
                                     {.file = checkpoint, .seconds_between = seconds_between, .resume = true});
    } catch (const dem::InputError&) {
      // Damaged, or of an earlier version: what it would save is not worth a failed task.
    }
  }
  return virtual_tests::run_test(specimen, card, options, progress,
                                 {.file = checkpoint, .seconds_between = seconds_between});
}

}  // namespace

TaskOutcome run_task(const std::string& key, const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const VirtualTest& test, const fs::path& checkpoint,
                     const dem::ProgressCallback& progress) {
  virtual_tests::TestOptions options = test.options;
  virtual_tests::set_threads(options, 1);
  virtual_tests::TestOutcome found = go_on_or_anew(specimen, card, options, checkpoint, progress);
  std::error_code ignored;
  fs::remove(checkpoint, ignored);
  TaskOutcome outcome;
  outcome.result.values = virtual_tests::values_of(found);
  outcome.result.curve = std::move(found.curve);
  outcome.time.wall_seconds = found.wall_seconds;
  outcome.time.step_loop_seconds = found.run ? found.run->step_loop_seconds : 0;
  outcome.result.key = key;
  outcome.result.values.emplace_back("specimen_sha256", specimen.sha256());
  outcome.time.host = host_name();
  return outcome;
}

}  // namespace study
