// spall study [plan | run | status | report]
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/console.h"
#include "app/output.h"
#include "app/report_page.h"
#include "app/report_words.h"
#include "app/study_plan.h"
#include "app/study_slurm.h"
#include "app/verbs.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/run/checkpoint_interval.h"
#include "study/plan.h"
#include "study/rows.h"
#include "study/runner.h"
#include "study/status.h"
#include "study/study_orientation.h"
#include "study/study_result.h"

namespace app {
namespace {

struct StudyOptions {
  CommonOptions common;
  std::string file, output, tasks, share;
  std::uint64_t memory = 0;
  bool retry_failed = false, resume = false;
  SlurmChoices slurm;
};

study::Plan read_plan(const StudyOptions& options) { return study::make_plan(study::read_study(options.file)); }

int plan_study(const StudyOptions& options) {
  const study::Plan plan = read_plan(options);
  Console console(options.common);
  for (const std::string& line : plan_lines(plan, options.common.thread_count())) console.say(line);
  console.result(plan_json(plan, options.common.thread_count()));
  return done;
}

struct Share {
  std::size_t index = 0, count = 1;
};

std::size_t number_from(const char* text) {
  std::size_t value = 0;
  const std::string_view all(text);
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), value);
  return error == std::errc{} && end == all.data() + all.size() ? value : static_cast<std::size_t>(-1);
}

/// "2/8", or "mpi": what the launcher says of this process (Open MPI, then MPICH and Intel MPI, then srun).
Share parse_share(const std::string& text) {
  const auto refuse = [&](const std::string& wrong) {
    throw dem::InputError("--share", wrong,
                          "write it as in 2/8, from 1/8 to 8/8, or as mpi under mpirun or srun");
  };
  Share share;
  if (text == "mpi") {
    for (const auto& [rank, size] :
         {std::pair("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"), std::pair("PMI_RANK", "PMI_SIZE"),
          std::pair("SLURM_PROCID", "SLURM_NTASKS")}) {
      const char *own = std::getenv(rank), *all = std::getenv(size);
      if (own == nullptr || all == nullptr) continue;
      share = {number_from(own), number_from(all)};
      if (share.index >= share.count) refuse(fmt::format("{} is {} and {} is {}", rank, own, size, all));
      return share;
    }
    refuse("is mpi, and no launcher has set OMPI_COMM_WORLD_RANK, PMI_RANK or SLURM_PROCID");
  }
  const std::size_t slash = text.find('/');
  const std::size_t number = number_from(text.substr(0, slash).c_str());
  share.count = slash == std::string::npos ? 0 : number_from(text.substr(slash + 1).c_str());
  constexpr std::size_t most = 1'000'000;
  if (number < 1 || share.count > most || number > share.count) refuse(fmt::format("\"{}\" is no share", text));
  share.index = number - 1;
  return share;
}

Json failures_json(const study::Plan& plan, const std::vector<study::TaskFailure>& failures) {
  Json list = Json::array();
  for (const study::TaskFailure& failure : failures)
    list.push_back({{"task", plan.tasks[failure.task].number}, {"message", failure.message}});
  return list;
}

study::RunOutcome run_or_stop(const StudyOptions& options, const Invocation& invocation,
                              const study::Plan& plan, const std::vector<std::size_t>& chosen,
                              Console& console) {
  const study::StudyFolder folder(options.output);
  study::RunOptions how;
  // A launcher that starts a process a core wants one thread from each.
  how.threads = options.share == "mpi" && options.common.threads == 0 ? 1 : options.common.thread_count();
  how.memory = static_cast<double>(options.memory);
  how.retry_failed = options.retry_failed;
  const auto kept = [&] {
    std::size_t count = 0;
    for (const std::size_t task : chosen) count += folder.has_result(plan.tasks[task].key) ? 1 : 0;
    return fmt::format("{} of {} tasks have their results in {}", count, chosen.size(), options.output);
  };
  try {
    return study::run_tasks(plan, chosen, folder, how, console.progress());
  } catch (const dem::Interrupted& stop) {
    throw dem::Interrupted(
        fmt::format("{}; {}: go on with {}", stop.what(), kept(), command_to_go_on(invocation)));
  } catch (const dem::RunError& error) {
    throw dem::RunError(fmt::format("{}; {}, the same command goes on", error.what(), kept()));
  }
}

void say_summary(Console& console, const Json& result) {
  for (const auto& [name, s] : result["summary"].items())
    console.say(fmt::format("  {:<28} mean {:<10.4g} std {:<10.3g} min {:<10.4g} max {:<10.4g} spread {:.1f}%",
                            name, s["mean"].get<double>(), number(s, "std"), s["min"].get<double>(),
                            s["max"].get<double>(), 100 * s["spread_rel"].get<double>()));
}

RunFolder run_folder(const StudyOptions& options, const Invocation& invocation, const study::Plan& plan) {
  RunFolder folder(options.output, invocation, options.common);
  for (const dem::InputFile& input : plan.study.inputs) folder.add_input(input);
  for (const study::SpecimenRecipe& recipe : plan.study.specimens) folder.add_seed(recipe.packing.seed);
  return folder;
}

/// Before a run that ends with a report makes a result, the report of an earlier one goes.
void remove_earlier_report(const StudyOptions& options, const Invocation& invocation, const study::Plan& plan) {
  const study::StudyFolder folder(options.output);
  if (!std::filesystem::is_directory(options.output) ||
      std::all_of(plan.tasks.begin(), plan.tasks.end(),
                  [&](const study::Task& task) { return folder.has_result(task.key); }))
    return;
  run_folder(options, invocation, plan).remove_results({"rows.csv"});
}

/// result.json, rows.csv, run.json and report.html from the results in the folder.
Json write_study_report(const StudyOptions& options, const Invocation& invocation, const study::Plan& plan,
                        Console& console) {
  const RunFolder folder = run_folder(options, invocation, plan);
  const study::RowTable table = study::read_rows(plan, study::StudyFolder(options.output));
  Json result = study::result_json(plan, table);
  result["orientation"] = study::orientation_json(plan, study::StudyFolder(options.output));
  folder.remove_results({"rows.csv"});
  dem::write_file_atomically(folder.file("rows.csv"), study::rows_csv(plan, table));
  folder.write(result);
  write_report(folder.path());
  const std::size_t missing = table.tasks - table.rows.size() - table.failed.size();
  if (missing > 0)
    console.remark(
        fmt::format("the study is not complete: {} of {} tasks have no result yet", missing, table.tasks));
  say_summary(console, result);
  console.say(fmt::format("wrote result.json, rows.csv and report.html to {}", options.output));
  return result;
}

void throw_if_failed(const study::Plan& plan, const study::RunOutcome& outcome) {
  if (outcome.failures.empty()) return;
  const study::TaskFailure& first = outcome.failures.front();
  throw dem::RunError(
      fmt::format("{} of {} tasks failed, first task {} ({}, {}): {}; --retry-failed runs them again",
                  outcome.failures.size(), outcome.chosen, plan.tasks[first.task].number,
                  study::label_of(plan.specimen_of(plan.tasks[first.task])),
                  plan.test_of(plan.tasks[first.task]).name, first.message));
}

int run_study(const StudyOptions& options, const Invocation& invocation) {
  use_threads(options.common);
  dem::seconds_between_checkpoints(0);  // refused before an earlier report is removed
  const study::Plan plan = read_plan(options);
  std::vector<std::size_t> chosen = study::choose_tasks(plan, options.tasks, "--tasks");
  if (!options.share.empty()) {
    const Share share = parse_share(options.share);
    chosen = study::share_of(plan, chosen, share.index, share.count);
  }
  Console console(options.common);
  if (options.slurm.wanted()) {
    // Cores are counted on the node, not on the machine that submits.
    const int threads = options.common.threads > 0 ? options.common.threads : 1;
    return submit_study({plan, chosen, options.file, options.output, threads,
                         static_cast<double>(options.memory), options.retry_failed},
                        options.slurm, console);
  }
  // A part does not report: other parts may be running, and two must not write one file.
  const bool reports = options.tasks.empty() && options.share.empty();
  if (reports) remove_earlier_report(options, invocation, plan);
  const study::RunOutcome outcome = run_or_stop(options, invocation, plan, chosen, console);
  console.say(fmt::format("{}: {} tasks, {} results made now, {} found, {} tasks failed", plan.study.name,
                          outcome.chosen, outcome.ran, outcome.results - std::min(outcome.results, outcome.ran),
                          outcome.failures.size()));
  if (!reports) {
    console.result(Json{{"tasks", outcome.chosen},
                        {"results", outcome.results},
                        {"ran", outcome.ran},
                        {"failed", failures_json(plan, outcome.failures)}});
  } else {
    console.result(write_study_report(options, invocation, plan, console));
  }
  throw_if_failed(plan, outcome);
  return done;
}

void require_study_folder(const std::string& folder) {
  if (!std::filesystem::is_directory(folder))
    throw dem::InputError(folder, "there is no such folder", "give the folder that spall study run has filled");
}

int status_of_study(const StudyOptions& options) {
  const study::Plan plan = read_plan(options);
  require_study_folder(options.output);
  const study::StudyFolder folder(options.output);
  const study::StudyStatus status = study::status_of(plan, folder);
  Console console(options.common);
  Json json{{"tasks", plan.tasks.size()}, {"done", status.done},
            {"failed", status.failed},    {"running", status.running},
            {"missing", status.missing},  {"core_seconds_left", status.seconds_left},
            {"states", Json::array()},    {"failures", Json::array()}};
  constexpr std::size_t most_messages = 20;
  std::size_t messages = 0;
  for (std::size_t k = 0; k < plan.tasks.size(); ++k) {
    const study::Task& task = plan.tasks[k];
    json["states"].push_back(study::name_of(status.states[k]));
    if (status.states[k] != study::TaskState::failed) continue;
    const std::string message = folder.read_failure(task.key);
    json["failures"].push_back({{"task", task.number}, {"message", message}});
    if (messages++ < most_messages)
      console.say(fmt::format("task {} failed ({}, {}): {}", task.number,
                              study::label_of(plan.specimen_of(task)), plan.test_of(task).name, message));
  }
  std::string line = fmt::format("{} of {} tasks done, {} running, {} missing, {} failed", status.done,
                                 plan.tasks.size(), status.running, status.missing, status.failed);
  if (status.running + status.missing > 0)
    line += fmt::format("; about {} left on {} threads",
                        duration(status.seconds_left / options.common.thread_count()),
                        options.common.thread_count());
  console.say(line);
  if (Json slurm = tell_slurm_status(plan, options.output, status.states, console); !slurm.is_null())
    json["slurm"] = std::move(slurm);
  console.result(json);
  return done;
}

int report_study(const StudyOptions& options, const Invocation& invocation) {
  const study::Plan plan = read_plan(options);
  require_study_folder(options.output);
  Console console(options.common);
  console.result(write_study_report(options, invocation, plan, console));
  return done;
}

const std::string small_study =
    "spall card example -o card.toml\n"
    "printf 'card = \"card.toml\"\\ntests = [\"elastic\"]\\n' > study.toml\n"
    "printf '[[specimen]]\\nsize = \"0.4x0.2x0.2 m\"\\nelements = 1400\\nseeds = \"1-2\"\\n' >> study.toml\n";

void add_running(CLI::App* verb, StudyOptions& options) {
  verb->add_option("--memory", options.memory,
                   "Memory for all tasks at a time, as 8GB (default: nine tenths of what is available)")
      ->transform(CLI::AsSizeValue(false))
      ->transform(CLI::Validator(
          [](std::string& text) {
            const bool number = !text.empty() && text[0] >= '0' && text[0] <= '9';
            return number ? std::string() : fmt::format("\"{}\" is no amount of memory, as 8GB is", text);
          },
          ""));
  verb->add_flag("--retry-failed", options.retry_failed, "Run tasks again that failed before");
  verb->add_flag("--resume", options.resume, "Go on where a run was stopped: a study always does");
}

}  // namespace

void add_study(CLI::App& root, Invocation& invocation) {
  const auto options = std::make_shared<StudyOptions>();
  const auto add_file = [&](CLI::App* verb) {
    return verb->add_option("study", options->file, "Study (TOML): specimens, cards, parameters, tests");
  };
  const auto add_output = [&](CLI::App* verb) {
    return verb->add_option("-o,--output", options->output,
                            "Folder for result.json, rows.csv, report.html and the results of the tasks");
  };
  CLI::App* study =
      add_verb(root, "study", "Many specimens, many settings, many tests: planned in a file, run anywhere",
               small_study + "spall study study.toml -o out/study", options->common);
  study->require_subcommand(0, 1);
  add_file(study);
  add_output(study);
  add_running(study, *options);
  study->callback([study, options, &invocation] {
    if (!study->get_subcommands().empty()) return;
    if (options->file.empty()) throw CLI::RequiredError("study");
    if (options->output.empty()) throw CLI::RequiredError("--output");
    invocation.action = [options, &invocation] { return run_study(*options, invocation); };
  });

  const auto add = [&](const std::string& name, const std::string& description, const std::string& example,
                       const std::function<int()>& action) {
    CLI::App* verb = add_verb(*study, name, description, example, options->common);
    add_file(verb)->required();
    verb->callback([action, &invocation] { invocation.action = action; });
    return verb;
  };
  add("plan", "Show a study's tasks and how long they will take", small_study + "spall study plan study.toml",
      [options] { return plan_study(*options); });
  CLI::App* run = add("run", "Run the tasks that have no result yet, then report; or a part of the tasks",
                      small_study +
                          "spall study run study.toml -o out/study --tasks 1-2\n"
                          "spall study run study.toml -o out/study",
                      [options, &invocation] { return run_study(*options, invocation); });
  add_output(run)->required();
  run->add_option("--tasks", options->tasks, "Only these tasks, by their numbers in the plan, as 1-10,12");
  run->add_option(
      "--share", options->share,
      "Only this share of the tasks: 2/8, or mpi for the one of the rank that mpirun or srun gives");
  add_slurm_options(run, options->slurm);
  add_running(run, *options);
  const std::string after = small_study + "spall study run study.toml -o out/study\n";
  add_output(add("status", "Say how far a study is", after + "spall study status study.toml -o out/study",
                 [options] { return status_of_study(*options); }))
      ->required();
  add_output(add("report", "Write result.json, rows.csv and report.html from the results that are there",
                 after + "spall study report study.toml -o out/study",
                 [options, &invocation] { return report_study(*options, invocation); }))
      ->required();
}

}  // namespace app
