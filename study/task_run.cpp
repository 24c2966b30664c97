#include "study/task_run.h"

#include <unistd.h>

#include <system_error>

#include "libdem/core/error.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/setup.h"

namespace study {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

std::int64_t whole(std::size_t value) { return static_cast<std::int64_t>(value); }

std::string letter_of(int axis) { return std::string(1, "xyz"[axis]); }

TaskOutcome elastic(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                    const VirtualTest& test) {
  const int axis = virtual_tests::loading_axis(specimen, test.options.axis);
  const auto found = virtual_tests::run_elastic(specimen, card, {.axis = axis});
  TaskOutcome outcome;
  outcome.result.values = {{"E", found.young_modulus},
                           {"nu", found.poisson_ratio},
                           {"links", whole(specimen.links.size())},
                           {"axis", letter_of(axis)},
                           {"iterations", std::int64_t{found.iterations}}};
  outcome.time.wall_seconds = found.wall_seconds;
  return outcome;
}

virtual_tests::UniaxialResult go_on_or_anew(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                            const virtual_tests::UniaxialOptions& options,
                                            const fs::path& checkpoint, const dem::ProgressCallback& progress) {
  constexpr double seconds_between = 120;
  if (fs::exists(checkpoint)) {
    try {
      return virtual_tests::run_uniaxial(
          specimen, card, options, progress,
          {.file = checkpoint, .seconds_between = seconds_between, .resume = true});
    } catch (const dem::InputError&) {
      // Damaged, or of an earlier version: what it would save is not worth a failed task.
    }
  }
  return virtual_tests::run_uniaxial(specimen, card, options, progress,
                                     {.file = checkpoint, .seconds_between = seconds_between});
}

TaskOutcome uniaxial(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const VirtualTest& test, const fs::path& checkpoint,
                     const dem::ProgressCallback& progress) {
  virtual_tests::UniaxialOptions options = test.options;
  options.threads = 1;
  options.axis = virtual_tests::loading_axis(specimen, options.axis);
  virtual_tests::UniaxialResult found = go_on_or_anew(specimen, card, options, checkpoint, progress);
  std::error_code ignored;
  fs::remove(checkpoint, ignored);
  TaskOutcome outcome;
  outcome.result.values = {{"ends", std::string(dem::name_of(options.ends))},
                           {"axis", letter_of(options.axis)},
                           {"peak_stress", found.peak_stress},
                           {"peak_strain", found.peak_strain},
                           {"E", found.young_modulus},
                           {"nu", found.poisson_ratio},
                           {"work_of_fracture", found.work_of_fracture},
                           {"passed_peak", found.passed_peak},
                           {"quasi_static", found.quasi_static()},
                           {"broken_links", whole(found.broken_links)},
                           {"links", whole(found.links)},
                           {"damage", found.damage_ratio()},
                           {"velocity", found.velocity},
                           {"damping", options.damping},
                           {"steps", std::int64_t{found.steps}},
                           {"time_step", found.time_step},
                           {"critical_time_step", found.critical_time_step},
                           {"energy_balance_error", found.energy_balance_error},
                           {"unbalanced_force_ratio", found.unbalanced_force_ratio},
                           {"state_sha256", found.state_sha256}};
  outcome.result.curve = std::move(found.curve);
  outcome.time.wall_seconds = found.wall_seconds;
  outcome.time.step_loop_seconds = found.step_loop_seconds;
  return outcome;
}

}  // namespace

TaskOutcome run_task(const std::string& key, const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const VirtualTest& test, const fs::path& checkpoint,
                     const dem::ProgressCallback& progress) {
  TaskOutcome outcome = test.kind == TestKind::elastic ? elastic(specimen, card, test)
                                                       : uniaxial(specimen, card, test, checkpoint, progress);
  outcome.result.key = key;
  outcome.result.values.emplace_back("specimen_sha256", specimen.sha256());
  outcome.time.host = host_name();
  return outcome;
}

}  // namespace study
