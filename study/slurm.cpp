#include "study/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "libdem/core/error.h"

namespace study {
namespace {

constexpr double chunk_seconds = 600;
constexpr double least_seconds = 300;
/// The command itself with its libraries.
constexpr double program_bytes = 200e6;
constexpr double mebibyte = 1048576;

// What the script must settle itself: elements find their tasks by the index, and status its logs.
constexpr std::array own_options = {"--array",    "--output",    "--error", "--wrap",    "--chdir",
                                    "--parsable", "--test-only", "--wait",  "--job-name"};
constexpr std::array own_letters = {"-a", "-o", "-e", "-D", "-W", "-J"};

bool one_line(std::string_view text) { return text.find_first_of(std::string_view("\n\r\0", 3)) == text.npos; }

void check_option(const std::string& option, const std::string& where) {
  if (!one_line(option))
    throw dem::InputError(where, "an option for sbatch has a line break in it", "one line");
  if (option.size() < 2 || option[0] != '-' || option == "--")
    throw dem::InputError(where, "\"" + option + "\" is no option of sbatch",
                          "one word each, as in --sbatch-option=--constraint=avx512");
  const std::string name = option.substr(0, option.find('='));
  const bool own = std::find(own_options.begin(), own_options.end(), name) != own_options.end() ||
                   (name[1] != '-' &&
                    std::find(own_letters.begin(), own_letters.end(), name.substr(0, 2)) != own_letters.end());
  if (own) throw dem::InputError(where, "sbatch's " + name + " is set by the study itself", "leave it out");
}

/// A word of an #SBATCH line: sbatch drops a backslash and takes the letter behind it, and ends a line at '#'.
std::string sbatch_word(std::string_view text) {
  std::string word = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') word += '\\';
    word += letter;
  }
  return word + '"';
}

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'')
      word += "'\\''";
    else
      word += letter;
  }
  return word + "'";
}

/// For names in which Slurm replaces %A by the job's number and %a by the element's.
std::string without_patterns(std::string text) {
  for (std::size_t at = 0; (at = text.find('%', at)) != std::string::npos; at += 2) text.insert(at, 1, '%');
  return text;
}

/// "1-02:30:00" or "02:30:00".
std::string time_text(double seconds) {
  const auto minutes = static_cast<long long>(std::ceil(seconds / 60));
  const std::string clock = fmt::format("{:02}:{:02}:00", minutes / 60 % 24, minutes % 60);
  return minutes >= 24 * 60 ? fmt::format("{}-{}", minutes / (24 * 60), clock) : clock;
}

/// Tasks of one element and what their estimates come to.
struct Load {
  double sum = 0, longest = 0;
  std::vector<double> memory;

  void add(const SlurmTask& task) {
    sum += task.seconds;
    longest = std::max(longest, task.seconds);
    memory.push_back(task.bytes);
  }
  double seconds(int threads) const { return std::max(longest, sum / threads); }
  double bytes(int threads) {
    const auto at_once = std::min(memory.size(), static_cast<std::size_t>(threads));
    std::partial_sort(memory.begin(), memory.begin() + static_cast<std::ptrdiff_t>(at_once), memory.end(),
                      std::greater<>());
    double total = program_bytes;
    for (std::size_t k = 0; k < at_once; ++k) total += memory[k];
    return total;
  }
};

}  // namespace

void check(const SlurmOptions& options, const std::string& where) {
  for (const std::string& option : options.sbatch_options) check_option(option, where);
  for (const std::string* name : {&options.partition, &options.account})
    if (!one_line(*name)) throw dem::InputError(where, "a name has a line break in it", "one line");
  if (!(options.time_factor >= 1))
    throw dem::InputError(where, fmt::format("the factor on the estimated time is {}", options.time_factor),
                          "at least 1");
}

std::vector<Chunk> make_chunks(const std::vector<SlurmTask>& tasks, const SlurmOptions& options) {
  std::vector<SlurmTask> ordered = tasks;
  std::sort(ordered.begin(), ordered.end(),
            [](const SlurmTask& a, const SlurmTask& b) { return a.number < b.number; });
  std::vector<Chunk> chunks;
  Load load;
  const auto close = [&] {
    if (load.memory.empty()) return;
    chunks.back().seconds = load.seconds(options.threads);
    chunks.back().bytes = load.bytes(options.threads);
    load = Load();
  };
  for (const SlurmTask& task : ordered) {
    const bool full = options.chunk > 0 ? load.memory.size() == options.chunk
                                        : (load.sum + task.seconds) / options.threads > chunk_seconds;
    if (full) close();
    if (load.memory.empty()) chunks.emplace_back();
    load.add(task);
    chunks.back().tasks.push_back(task.number);
  }
  close();
  return chunks;
}

std::string range_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t end = k;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
    if (!text.empty()) text += ',';
    text += fmt::to_string(numbers[k]);
    if (end > k) text += fmt::format("-{}", numbers[end]);
    k = end + 1;
  }
  return text;
}

double time_limit(const std::vector<Chunk>& chunks, const SlurmOptions& options) {
  if (options.time_limit > 0) return options.time_limit;
  double longest = 0;
  for (const Chunk& chunk : chunks) longest = std::max(longest, chunk.seconds);
  return std::max(least_seconds, 60 * std::ceil(longest * options.time_factor / 60));
}

double memory_limit(const std::vector<Chunk>& chunks, const SlurmOptions& options) {
  if (options.memory > 0) return options.memory;
  double largest = 0;
  for (const Chunk& chunk : chunks) largest = std::max(largest, chunk.bytes);
  return 2 * largest;
}

std::string batch_script(const SlurmPlace& place, const std::vector<Chunk>& chunks,
                         const SlurmOptions& options) {
  for (const std::filesystem::path& path :
       {place.program, place.study, place.output, place.logs, place.working})
    if (!one_line(path.string()))
      throw dem::InputError(path.filename().string(),
                            "its name has a line break in it, which no script can hold", "rename it");
  if (place.logs.string().find('\\') != std::string::npos)
    throw dem::InputError(place.output.string(),
                          "there is a backslash in this path, and Slurm would not name its logs",
                          "choose a folder without");

  std::string name = place.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::string text = "#!/bin/bash\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# Study \"{}\": written by `spall study run --on slurm`.\n", name);
  const auto set = [&](const std::string& option) { fmt::format_to(out, "#SBATCH {}\n", sbatch_word(option)); };
  set("--job-name=spall-" + name);
  set(fmt::format("--array=0-{}", chunks.size() - 1));
  set("--time=" + time_text(time_limit(chunks, options)));
  set(fmt::format("--mem={}M", static_cast<long long>(std::ceil(memory_limit(chunks, options) / mebibyte))));
  set("--nodes=1");
  set("--ntasks=1");
  set(fmt::format("--cpus-per-task={}", options.threads));
  set("--chdir=" + place.working.string());
  set("--output=" + without_patterns(place.logs.string()) + "/%A_%a.log");
  if (!options.partition.empty()) set("--partition=" + options.partition);
  if (!options.account.empty()) set("--account=" + options.account);
  // Last, so that they win over what stands above.
  for (const std::string& option : options.sbatch_options) set(option);

  text += "tasks=(\n";
  for (const Chunk& chunk : chunks) fmt::format_to(out, "  {}\n", range_text(chunk.tasks));
  text += ")\n";
  // In the shell's place, so that Slurm's signals reach it.
  fmt::format_to(
      out, "exec {} study run {} -o {} --tasks \"${{tasks[SLURM_ARRAY_TASK_ID]}}\" --threads {} --memory {}",
      shell_word(place.program.string()), shell_word(place.study.string()), shell_word(place.output.string()),
      options.threads, static_cast<long long>(memory_limit(chunks, options)));
  for (const std::string& argument : place.arguments) fmt::format_to(out, " {}", shell_word(argument));
  return text + "\n";
}

}  // namespace study
