// `spall study run --on slurm`, and what `spall study status` says of jobs that were submitted.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/console.h"
#include "study/plan.h"
#include "study/status.h"

namespace app {

/// What the command line says about a submission, as typed.
struct SlurmChoices {
  std::string on = "here";
  std::size_t chunk = 0;
  std::string time_limit;
  double time_factor = 4;
  std::string partition, account;
  std::vector<std::string> sbatch_options;

  bool wanted() const { return on == "slurm"; }
};
void add_slurm_options(CLI::App* run, SlurmChoices& choices);

/// A study as far as its submission needs it.
struct SlurmStudy {
  const study::Plan& plan;
  std::vector<std::size_t> chosen;  ///< indices into plan.tasks
  std::string file, output;
  int threads = 1;    ///< of one element of the array
  double memory = 0;  ///< of one element [bytes]; 0: from the estimate
  bool retry_failed = false;
};

/// Submits the chosen tasks that have no result and are not in flight. Throws InputError and RunError.
int submit_study(const SlurmStudy& what, const SlurmChoices& choices, Console& console);

/// elements[] and no_accounting, or error where squeue does not answer; null if nothing was ever submitted.
nlohmann::ordered_json tell_slurm_status(const study::Plan& plan, const std::string& output,
                                         const std::vector<study::TaskState>& states, Console& console);

}  // namespace app
