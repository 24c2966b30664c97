#include "app/study_slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "app/output.h"
#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "libdem/core/units.h"
#include "study/slurm_submission.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Names what the tasks' numbers mean.
std::string name_of_plan(const study::Plan& plan) {
  std::string keys;
  for (const study::Task& task : plan.tasks) keys += task.key + "\n";
  return dem::sha256_of(keys);
}

study::SlurmOptions options_of(const SlurmStudy& what, const SlurmChoices& choices) {
  study::SlurmOptions options;
  options.chunk = choices.chunk;
  options.time_factor = choices.time_factor;
  options.memory = what.memory;
  options.threads = what.threads;
  options.partition = choices.partition;
  options.account = choices.account;
  options.sbatch_options = choices.sbatch_options;
  if (!choices.time_limit.empty()) {
    options.time_limit = dem::parse_quantity(choices.time_limit, dem::Quantity::time, "--time-limit");
    if (!(options.time_limit > 0))
      throw dem::InputError("--time-limit", "\"" + choices.time_limit + "\" is no time to run in",
                            "more than 0");
  }
  return options;
}

/// The tasks to run: without result, one for each result.
std::vector<study::SlurmTask> wanted_tasks(const SlurmStudy& what, const std::vector<study::TaskState>& states,
                                           std::size_t& failed) {
  std::vector<study::SlurmTask> wanted;
  std::set<std::string> keys;
  for (const std::size_t index : what.chosen) {
    const study::Task& task = what.plan.tasks[index];
    if (states[index] == study::TaskState::done) continue;
    if (states[index] == study::TaskState::failed && !what.retry_failed) {
      ++failed;
      continue;
    }
    if (keys.insert(task.key).second) wanted.push_back({task.number, task.seconds, task.bytes});
  }
  return wanted;
}

Json json_of(const study::Submitted& submitted) {
  Json json{{"arrays", Json::array()}, {"in_flight", study::range_text(submitted.in_flight)}};
  for (const study::Submission& array : submitted.arrays) {
    Json chunks = Json::array();
    for (const auto& chunk : array.chunks) chunks.push_back(study::range_text(chunk));
    json["arrays"].push_back({{"job", array.job.number},
                              {"cluster", array.job.cluster},
                              {"chunks", chunks},
                              {"time_limit", array.time_limit},
                              {"memory", array.memory},
                              {"script", array.script.string()}});
  }
  return json;
}

std::string state_words(const study::ElementState& state) {
  std::string words(study::name_of(state.state));
  if (!state.reason.empty()) words += " (" + state.reason + ")";
  return words;
}

/// "job 12: 3 elements finished, 1 running", one line an array.
void say_jobs(const std::vector<study::ElementStatus>& elements, Console& console) {
  std::map<study::JobName, std::map<study::JobState, std::size_t>> counts;
  std::vector<study::JobName> order;
  for (const study::ElementStatus& element : elements) {
    if (!counts.contains(element.job)) order.push_back(element.job);
    ++counts[element.job][element.slurm.state];
  }
  for (const study::JobName& job : order) {
    std::string line;
    for (const auto& [state, count] : counts[job])
      line += fmt::format("{}{} {}", line.empty() ? "" : ", ", count, study::name_of(state));
    console.say(
        fmt::format("Slurm job {}{}{}: {}", job.number, job.cluster.empty() ? "" : " on ", job.cluster, line));
  }
}

bool wants_attention(const study::ElementStatus& element) {
  return !study::in_flight(element.slurm.state) && element.slurm.state != study::JobState::finished &&
         !element.other_plan && element.done < element.tasks.size();
}

}  // namespace

void add_slurm_options(CLI::App* run, SlurmChoices& choices) {
  auto* on = run->add_option("--on", choices.on,
                             "Where: here, or slurm, which submits the tasks as a job array and returns")
                 ->check(CLI::IsMember({"here", "slurm"}));
  const std::string group = "With --on slurm";
  run->add_option("--chunk", choices.chunk, "Tasks of one element of the array (default: ten minutes' worth)")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(on)
      ->group(group);
  auto* limit =
      run->add_option("--time-limit", choices.time_limit,
                      "Time limit of an element, as \"2 hours\" (default: its estimate times the factor)");
  limit->needs(on)->group(group);
  run->add_option("--time-factor", choices.time_factor, "What the estimate is multiplied by (default: 4)")
      ->check(number_between(1, 1000))
      ->excludes(limit)
      ->needs(on)
      ->group(group);
  run->add_option("--partition", choices.partition, "Partition (default: the cluster's)")
      ->needs(on)
      ->group(group);
  run->add_option("--account", choices.account, "Account (default: the cluster's)")->needs(on)->group(group);
  run->add_option("--sbatch-option", choices.sbatch_options,
                  "Another option for sbatch, as --sbatch-option=--constraint=avx512; may stand several times")
      ->allow_extra_args(false)
      ->needs(on)
      ->group(group);
}

int submit_study(const SlurmStudy& what, const SlurmChoices& choices, Console& console) {
  study::SlurmRequest request;
  request.options = options_of(what, choices);
  const study::StudyFolder folder(what.output);
  const study::StudyStatus status = study::status_of(what.plan, folder);
  std::size_t failed = 0;
  request.tasks = wanted_tasks(what, status.states, failed);
  if (request.tasks.empty()) {
    if (failed > 0)
      throw dem::RunError(
          fmt::format("{}: nothing to submit: {} of {} tasks failed; --retry-failed submits them again",
                      what.output, failed, what.chosen.size()));
    console.say(fmt::format("every task has its result; write the table with: spall study report {} -o {}",
                            what.file, what.output));
    console.result(json_of({}));
    return done;
  }
  request.states = status.states;
  request.plan = name_of_plan(what.plan);
  request.now = utc_now();
  request.place.name = what.plan.study.name;
  request.place.program = fs::read_symlink("/proc/self/exe");
  request.place.study = fs::absolute(what.file);
  request.place.output = fs::absolute(what.output);
  request.place.working = fs::current_path();
  if (what.retry_failed) request.place.arguments.emplace_back("--retry-failed");

  const study::Submitted submitted = study::submit(request);
  for (const study::Submission& array : submitted.arrays)
    console.say(fmt::format("submitted Slurm job {}: {} element{}, each with {} and {:.2g} GB",
                            array.job.number, array.chunks.size(), array.chunks.size() == 1 ? "" : "s",
                            duration(array.time_limit), array.memory / 1e9));
  if (!submitted.in_flight.empty())
    console.remark(
        fmt::format("left out, since they are in flight: tasks {}", study::range_text(submitted.in_flight)));
  if (failed > 0)
    console.remark(
        fmt::format("left out, since they failed: {} tasks; --retry-failed takes them along", failed));
  console.say(fmt::format("how far it is: spall study status {} -o {}", what.file, what.output));
  console.result(json_of(submitted));
  return done;
}

Json tell_slurm_status(const study::Plan& plan, const std::string& output,
                       const std::vector<study::TaskState>& states, Console& console) {
  study::SlurmStatus status;
  try {
    status = study::slurm_status(output, states, name_of_plan(plan));
  } catch (const dem::RunError& error) {
    // The results tell how far the study is without Slurm.
    console.remark(error.what());
    return {{"error", error.what()}};
  }
  if (status.elements.empty()) return nullptr;
  say_jobs(status.elements, console);
  Json json{{"elements", Json::array()}, {"no_accounting", status.no_accounting}};
  constexpr std::size_t most_lines = 20;
  std::size_t lines = 0;
  for (const study::ElementStatus& element : status.elements) {
    json["elements"].push_back({{"job", element.job.number},
                                {"cluster", element.job.cluster},
                                {"element", element.index},
                                {"tasks", study::range_text(element.tasks)},
                                {"state", study::name_of(element.slurm.state)},
                                {"slurm_state", element.slurm.word},
                                {"reason", element.slurm.reason},
                                {"done", element.done},
                                {"failed", element.failed},
                                {"missing", element.missing},
                                {"earlier_version", element.other_plan}});
    if (wants_attention(element) && lines++ < most_lines)
      console.say(fmt::format(
          "  {}_{} {}: tasks {}, {} of {} done; see {}", element.job.number, element.index,
          state_words(element.slurm), study::range_text(element.tasks), element.done, element.tasks.size(),
          (fs::path(output) / "slurm" / fmt::format("{}_{}.log", element.job.number, element.index)).string()));
  }
  return json;
}

}  // namespace app
