#include "study/slurm_queue.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "libdem/core/error.h"
#include "study/slurm_command.h"

namespace study {
namespace {

/// More elements than any Slurm allows: what claims to have more is no list of indices.
constexpr std::size_t most_elements = 4'000'000;

struct Word {
  std::string_view word;
  JobState state;
};
// The states of `man squeue`; a job that is being requeued will wait again.
constexpr std::array words = {
    Word{"PENDING", JobState::pending},      Word{"REQUEUED", JobState::pending},
    Word{"REQUEUE_FED", JobState::pending},  Word{"REQUEUE_HOLD", JobState::pending},
    Word{"SPECIAL_EXIT", JobState::pending}, Word{"RESV_DEL_HOLD", JobState::pending},
    Word{"RUNNING", JobState::running},      Word{"CONFIGURING", JobState::running},
    Word{"COMPLETING", JobState::running},   Word{"SUSPENDED", JobState::running},
    Word{"STOPPED", JobState::running},      Word{"SIGNALING", JobState::running},
    Word{"STAGE_OUT", JobState::running},    Word{"RESIZING", JobState::running},
    Word{"COMPLETED", JobState::finished},   Word{"FAILED", JobState::failed},
    Word{"OUT_OF_MEMORY", JobState::failed}, Word{"NODE_FAIL", JobState::failed},
    Word{"BOOT_FAIL", JobState::failed},     Word{"LAUNCH_FAILED", JobState::failed},
    Word{"RECONFIG_FAIL", JobState::failed}, Word{"TIMEOUT", JobState::timed_out},
    Word{"DEADLINE", JobState::timed_out},   Word{"CANCELLED", JobState::cancelled},
    Word{"PREEMPTED", JobState::cancelled},  Word{"REVOKED", JobState::cancelled},
};

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(by);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::optional<std::size_t> number_in(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_number(std::string_view text) { return number_in(text).has_value(); }

/// "7" or "[3-9,20-40:2%4]". What is cut short ("...") gives what is there.
std::vector<std::size_t> indices_in(std::string_view text) {
  if (const auto single = number_in(text)) return {*single};
  std::vector<std::size_t> indices;
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return indices;
  text = text.substr(1, text.size() - 2);
  for (std::string_view part : split(text.substr(0, text.find('%')), ',')) {
    std::size_t step = 1;
    if (const std::size_t colon = part.find(':'); colon != std::string_view::npos) {
      step = std::max<std::size_t>(1, number_in(part.substr(colon + 1)).value_or(1));
      part = part.substr(0, colon);
    }
    const std::size_t dash = part.find('-');
    const auto first = number_in(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : number_in(part.substr(dash + 1));
    if (!first || !last || *last > most_elements) continue;
    for (std::size_t index = *first; index <= *last; index += step) indices.push_back(index);
  }
  return indices;
}

std::string joined_numbers(const std::vector<std::string>& numbers) {
  std::string text;
  for (const std::string& number : numbers) text += (text.empty() ? "" : ",") + number;
  return text;
}

ElementStates ask_squeue(const std::vector<std::string>& cluster, const std::string& numbers) {
  std::vector<std::string> command{"squeue",       "--noheader",        "--array",
                                   "--states=all", "--jobs=" + numbers, "--format=%F|%K|%T|%r"};
  command.insert(command.end(), cluster.begin(), cluster.end());
  const CommandOutcome said = run_command(command);
  if (!said.found)
    throw dem::RunError(
        "squeue is not on this machine: ask from one that the cluster's jobs are submitted from");
  if (said.code == 0) return parse_squeue(said.out);
  const std::string message = slurm_message(said);
  // All of them ended a while ago, and have left the queue's memory.
  if (message.find("Invalid job id") != std::string::npos) return {};
  throw dem::RunError("squeue does not answer: " + message);
}

/// The elements that sacct knows, or none and why.
ElementStates ask_sacct(const std::vector<std::string>& cluster, const std::string& numbers,
                        std::string& why_not) {
  std::vector<std::string> command{"sacct",         "--noheader",        "--parsable2",
                                   "--allocations", "--jobs=" + numbers, "--format=JobID,State,ExitCode"};
  command.insert(command.end(), cluster.begin(), cluster.end());
  const CommandOutcome said = run_command(command);
  if (said.found && said.code == 0) return parse_sacct(said.out);
  why_not = said.found ? slurm_message(said) : "sacct is not on this machine";
  return {};
}

}  // namespace

std::string_view name_of(JobState state) {
  switch (state) {
    case JobState::pending:
      return "pending";
    case JobState::running:
      return "running";
    case JobState::finished:
      return "finished";
    case JobState::failed:
      return "failed";
    case JobState::timed_out:
      return "timed out";
    case JobState::cancelled:
      return "cancelled";
    case JobState::gone:
      break;
  }
  return "gone";
}

bool in_flight(JobState state) { return state == JobState::pending || state == JobState::running; }

JobState job_state(std::string_view word) {
  word = word.substr(0, word.find_first_of(" +"));  // "CANCELLED by 0"; sacct marks what it cut short by a '+'
  for (const Word& known : words)
    if (known.word == word) return known.state;
  return JobState::failed;
}

ElementStates parse_squeue(std::string_view text) {
  ElementStates states;
  for (const std::string_view line : split(text, '\n')) {
    const auto fields = split(line, '|');
    if (fields.size() != 4 || !is_number(fields[0])) continue;
    const JobState state = job_state(fields[2]);
    // What held an element up before it ran is still there afterwards, and of no interest.
    const bool tells = state != JobState::running && state != JobState::finished && fields[3] != "None";
    for (const std::size_t index : indices_in(fields[1]))
      states[{std::string(fields[0]), index}] = {state, std::string(fields[2]),
                                                 std::string(tells ? fields[3] : std::string_view())};
  }
  return states;
}

ElementStates parse_sacct(std::string_view text) {
  ElementStates states;
  for (const std::string_view line : split(text, '\n')) {
    const auto fields = split(line, '|');
    if (fields.size() != 3) continue;
    const std::size_t under = fields[0].find('_');
    if (under == std::string_view::npos || !is_number(fields[0].substr(0, under))) continue;
    ElementState state{job_state(fields[1]), std::string(fields[1]), std::string()};
    const auto codes = split(fields[2], ':');
    if (state.state == JobState::failed && codes.size() == 2) {
      if (codes[0] != "0")
        state.reason = "exit code " + std::string(codes[0]);
      else if (codes[1] != "0")
        state.reason = "signal " + std::string(codes[1]);
    }
    for (const std::size_t index : indices_in(fields[0].substr(under + 1)))
      states[{std::string(fields[0].substr(0, under)), index}] = state;
  }
  return states;
}

QueueAnswer ask_slurm(const std::vector<JobName>& jobs) {
  QueueAnswer answer;
  std::map<std::string, std::vector<std::string>> by_cluster;
  for (const JobName& job : jobs) by_cluster[job.cluster].push_back(job.number);
  for (const auto& [name, numbers] : by_cluster) {
    std::vector<std::string> cluster;
    if (!name.empty()) cluster.push_back("--clusters=" + name);
    const std::string list = joined_numbers(numbers);
    ElementStates states = ask_squeue(cluster, list);
    // What squeue says is of now. Accounting comes later and fills the gaps, but what it takes to be in the
    // queue without squeue showing it is not there any more.
    ElementStates kept = ask_sacct(cluster, list, answer.no_accounting);
    std::erase_if(kept, [](const auto& element) { return in_flight(element.second.state); });
    states.merge(kept);
    for (const auto& [element, state] : states) answer.jobs[{element.first, name}][element.second] = state;
  }
  return answer;
}

}  // namespace study
