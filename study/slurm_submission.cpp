#include "study/slurm_submission.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "study/slurm_command.h"

namespace study {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* format_name = "spall-study-slurm";
constexpr int format_version = 1;

fs::path record_of(const fs::path& folder) { return folder / "slurm.json"; }

/// Held while one process submits. Where files cannot be locked, submitting goes on without: results do not
/// depend on it, two runners on one task only waste time.
class Turn {
 public:
  explicit Turn(const fs::path& folder)
      : file(::open((folder / ".slurm.lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
    if (file >= 0) ::flock(file, LOCK_EX);
  }
  ~Turn() {
    if (file >= 0) ::close(file);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int file;
};

Submission submission_of(const Json& entry) {
  Submission submission;
  submission.job = {entry.at("job").get<std::string>(), entry.at("cluster").get<std::string>()};
  submission.submitted = entry.at("submitted").get<std::string>();
  submission.plan = entry.at("plan").get<std::string>();
  submission.script = entry.at("script").get<std::string>();
  submission.time_limit = entry.at("time_limit").get<double>();
  submission.memory = entry.at("memory").get<double>();
  submission.chunks = entry.at("chunks").get<std::vector<std::vector<std::size_t>>>();
  return submission;
}

/// The longest array that this cluster takes; Slurm's own default if it does not say.
std::size_t longest_array() {
  const CommandOutcome said = run_command({"scontrol", "show", "config"});
  static const std::regex line(R"(MaxArraySize\s*=\s*(\d{1,9}))");
  std::smatch match;
  if (said.code == 0 && std::regex_search(said.out, match, line)) return std::max(1, std::stoi(match[1].str()));
  return 1001;
}

JobName call_sbatch(const fs::path& script) {
  const CommandOutcome said = run_command({"sbatch", "--parsable", script.string()});
  if (!said.found)
    throw dem::RunError(
        "sbatch is not on this machine: submit from one that the cluster takes jobs from, or let another "
        "scheduler run shares with --tasks");
  if (said.code != 0) {
    const std::string message = slurm_message(said);
    static const std::regex not_now(
        "contact slurm|timed out|temporarily|connect failure|establish a config|auth");
    if (std::regex_search(message, not_now)) throw dem::RunError("sbatch cannot submit: " + message);
    throw dem::InputError("sbatch", "it refuses the job array: " + message,
                          "--partition, --account, --time-limit, --memory, --threads and --sbatch-option say "
                          "what is asked of it");
  }
  static const std::regex name(R"((?:^|\n)(\d+)(?:;([^\s;]+))?\s*$)");
  std::smatch match;
  if (!std::regex_search(said.out, match, name))
    throw dem::RunError("sbatch answers \"" + slurm_message(said) + "\", which names no job");
  return {match[1].str(), match[2].str()};
}

/// A name that no script of this folder has.
fs::path new_script(const fs::path& logs) {
  for (int k = 1;; ++k) {
    fs::path script = logs / fmt::format("array-{}.sh", k);
    if (!fs::exists(script)) return script;
  }
}

std::vector<std::size_t> without_flying(std::vector<SlurmTask>& tasks, const SlurmStatus& status) {
  std::set<std::size_t> flying;
  for (const ElementStatus& element : status.elements) {
    if (!in_flight(element.slurm.state)) continue;
    if (element.other_plan)
      throw dem::RunError(fmt::format(
          "job {} of an earlier version of this study is still {}; wait for it, or end it with: scancel {}",
          element.job.number, name_of(element.slurm.state), element.job.number));
    flying.insert(element.tasks.begin(), element.tasks.end());
  }
  std::vector<std::size_t> left_out;
  std::erase_if(tasks, [&](const SlurmTask& task) {
    if (!flying.contains(task.number)) return false;
    left_out.push_back(task.number);
    return true;
  });
  std::sort(left_out.begin(), left_out.end());
  return left_out;
}

}  // namespace

std::vector<Submission> read_submissions(const fs::path& folder) {
  const fs::path file = record_of(folder);
  std::ifstream in(file);
  if (!in) return {};
  try {
    const Json record = Json::parse(in);
    if (record.at("format") == format_name && record.at("version") == format_version) {
      std::vector<Submission> submissions;
      for (const Json& entry : record.at("submissions")) submissions.push_back(submission_of(entry));
      return submissions;
    }
  } catch (const nlohmann::json::exception&) {  // said below
  }
  throw dem::InputError(file.string(), "it does not hold the jobs of a study",
                        "remove it if none of the study's jobs is in the queue");
}

void write_submissions(const fs::path& folder, const std::vector<Submission>& submissions) {
  Json record = {{"format", format_name}, {"version", format_version}, {"submissions", Json::array()}};
  for (const Submission& submission : submissions)
    record["submissions"].push_back({{"job", submission.job.number},
                                     {"cluster", submission.job.cluster},
                                     {"submitted", submission.submitted},
                                     {"plan", submission.plan},
                                     {"script", submission.script.string()},
                                     {"time_limit", submission.time_limit},
                                     {"memory", submission.memory},
                                     {"chunks", submission.chunks}});
  dem::write_file_atomically(record_of(folder), record.dump(1) + "\n");
}

std::vector<ElementStatus> element_states(const std::vector<Submission>& submissions, const QueueAnswer& answer,
                                          const std::vector<TaskState>& tasks, const std::string& plan) {
  std::vector<ElementStatus> elements;
  for (const Submission& submission : submissions) {
    const auto job = answer.jobs.find(submission.job);
    for (std::size_t index = 0; index < submission.chunks.size(); ++index) {
      ElementStatus element{submission.job, index, submission.chunks[index], {}};
      if (job != answer.jobs.end())
        if (const auto found = job->second.find(index); found != job->second.end())
          element.slurm = found->second;
      element.other_plan = submission.plan != plan;
      for (const std::size_t number : element.tasks) {
        if (element.other_plan || number == 0 || number > tasks.size()) continue;
        const TaskState state = tasks[number - 1];
        ++(state == TaskState::done     ? element.done
           : state == TaskState::failed ? element.failed
                                        : element.missing);
      }
      if (element.slurm.state == JobState::gone && element.done == element.tasks.size())
        element.slurm.state = JobState::finished;
      elements.push_back(std::move(element));
    }
  }
  return elements;
}

SlurmStatus slurm_status(const fs::path& folder, const std::vector<TaskState>& tasks, const std::string& plan) {
  const std::vector<Submission> submissions = read_submissions(folder);
  if (submissions.empty()) return {};
  std::vector<JobName> jobs;
  for (const Submission& submission : submissions) jobs.push_back(submission.job);
  const QueueAnswer answer = ask_slurm(jobs);
  return {element_states(submissions, answer, tasks, plan), answer.no_accounting};
}

Submitted submit(const SlurmRequest& request) {
  check(request.options, "spall study run");
  const fs::path& folder = request.place.output;
  SlurmPlace place = request.place;
  place.logs = folder / "slurm";
  dem::require_writable_folder(place.logs);
  const Turn turn(folder);

  Submitted submitted;
  std::vector<SlurmTask> tasks = request.tasks;
  submitted.in_flight = without_flying(tasks, slurm_status(folder, request.states, request.plan));
  if (tasks.empty() && !submitted.in_flight.empty())
    throw dem::RunError(
        fmt::format("{}: all tasks that want a result ({}) are in flight already; nothing was submitted",
                    folder.string(), range_text(submitted.in_flight)));
  std::vector<Submission> all = read_submissions(folder);
  const std::vector<Chunk> chunks = make_chunks(tasks, request.options);
  const std::size_t longest = longest_array();
  for (std::size_t begin = 0; begin < chunks.size(); begin += longest) {
    const std::size_t end = std::min(chunks.size(), begin + longest);
    const std::vector<Chunk> part(chunks.begin() + static_cast<std::ptrdiff_t>(begin),
                                  chunks.begin() + static_cast<std::ptrdiff_t>(end));
    const fs::path script = new_script(place.logs);
    dem::write_file_atomically(script, batch_script(place, part, request.options));
    Submission submission;
    try {
      submission.job = call_sbatch(script);
    } catch (...) {
      std::error_code ignored;
      fs::remove(script, ignored);
      throw;
    }
    submission.submitted = request.now;
    submission.plan = request.plan;
    submission.script = fs::path("slurm") / script.filename();
    submission.time_limit = time_limit(part, request.options);
    submission.memory = memory_limit(part, request.options);
    for (const Chunk& chunk : part) submission.chunks.push_back(chunk.tasks);
    all.push_back(submission);
    write_submissions(folder, all);
    submitted.arrays.push_back(std::move(submission));
  }
  return submitted;
}

}  // namespace study
