#include "app/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <string_view>

#include "app/machine.h"
#include "app/version.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/scratch_files.h"
#include "libdem/core/sha256.h"

namespace app {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string command_to_go_on(const Invocation& invocation) {
  std::string command;
  for (const std::string& word : invocation.arguments) {
    if (word == "--resume") continue;
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char letter) {
      return std::isalnum(letter) != 0 ||
             std::string_view("_-+=./,:@%").find(static_cast<char>(letter)) != std::string_view::npos;
    });
    std::string quoted = word;
    for (std::size_t at = 0; (at = quoted.find('\'', at)) != std::string::npos; at += 4)
      quoted.replace(at, 1, "'\\''");
    command += plain ? word + " " : "'" + quoted + "' ";
  }
  return command + "--resume";
}

namespace {

/// A command line without what changes no result: how it is told, on how many threads it is made, what the
/// folder is called.
std::vector<std::string> what_is_asked(const std::vector<std::string>& arguments) {
  std::vector<std::string> words;
  for (std::size_t k = 1; k < arguments.size(); ++k) {  // the program may have been called by another path
    const std::string& word = arguments[k];
    const bool with_value = word == "--threads" || word == "-o" || word == "--output";
    if (with_value) ++k;
    if (!with_value && word != "--resume" && word != "--quiet" && word != "--json" &&
        !word.starts_with("--threads=") && !word.starts_with("--output=") && !word.starts_with("-o"))
      words.push_back(word);
  }
  return words;
}

/// Whether the folder holds pictures that a run has made.
bool holds_frames(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".series") return true;
  return false;
}

dem::RunError cannot_be_removed(const std::filesystem::path& file, const std::error_code& error) {
  return dem::RunError(fmt::format("{}: cannot be removed ({})", file.string(), error.message()));
}

}  // namespace

void remove_if_empty(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::is_empty(folder, ignored)) std::filesystem::remove(folder, ignored);
}

EarlierResults::EarlierResults(const std::vector<std::filesystem::path>& earlier) {
  for (const std::filesystem::path& file : earlier) {
    std::error_code error;
    std::filesystem::rename(file, dem::scratch_path(file), error);
    if (!error) {
      files.insert(files.begin(), file);
    } else if (error != std::errc::no_such_file_or_directory) {
      put_back();
      throw cannot_be_removed(file, error);
    }
  }
}

EarlierResults::~EarlierResults() {
  std::error_code ignored;  // what stays is swept by the next run
  for (const std::filesystem::path& file : files) std::filesystem::remove_all(dem::scratch_path(file), ignored);
}

void EarlierResults::put_back() noexcept {
  std::error_code ignored;
  for (const std::filesystem::path& file : files)
    std::filesystem::rename(dem::scratch_path(file), file, ignored);
  files.clear();
}

RunFolder::RunFolder(const std::filesystem::path& where, const Invocation& call, const CommonOptions& common)
    : folder(where), invocation(call), threads(common.thread_count()) {
  if (folder.empty()) throw dem::InputError("-o", "is empty", "name a folder for what comes out");
  dem::require_writable_folder(folder);
  dem::sweep_scratch(folder);
}

void RunFolder::claim() {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  lock = std::shared_ptr<const int>(new int(descriptor), [](const int* held) {
    ::close(*held);
    delete held;
  });
  // Where the file system has no locks nobody is kept out.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw dem::InputError(folder.string(), "another run is at work in this folder",
                          "wait for its end, or give another folder to -o");
}

void RunFolder::add_input(const std::filesystem::path& input) {
  inputs.push_back({{"file", input.string()}, {"sha256", dem::sha256_of_file(input)}});
}

void RunFolder::add_input(const dem::InputFile& input) {
  inputs.push_back({{"file", input.file.string()}, {"sha256", input.sha256}});
}

void RunFolder::add_seed(std::uint64_t seed) { seeds.push_back(seed); }

bool RunFolder::is_input(const std::filesystem::path& file) const {
  return std::any_of(inputs.begin(), inputs.end(), [&](const nlohmann::ordered_json& input) {
    std::error_code ignored;
    return std::filesystem::equivalent(input.at("file").get<std::string>(), file, ignored);
  });
}

bool RunFolder::is_finished() const {
  try {
    std::ifstream before(file("run.json")), result(file("result.json"));
    const nlohmann::ordered_json run = nlohmann::ordered_json::parse(before);
    return nlohmann::ordered_json::accept(result) && run.at("inputs") == inputs &&
           what_is_asked(run.at("command_line").get<std::vector<std::string>>()) ==
               what_is_asked(invocation.arguments);
  } catch (const nlohmann::json::exception&) {
    return false;  // not there, or of something else
  }
}

std::vector<std::filesystem::path> RunFolder::results(const std::vector<std::string>& others) const {
  std::vector<std::string> names{"result.json", "run.json", "report.html"};
  names.insert(names.end(), others.begin(), others.end());
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) {
    if (is_input(file(name)))
      throw dem::InputError(file(name).string(), "is an input of this run, which would write its result there",
                            "give another folder to -o, or the input another name");
    files.push_back(file(name));
  }
  return files;
}

std::vector<std::filesystem::path> RunFolder::results_and_frames(const std::vector<std::string>& others,
                                                                 bool frames) const {
  std::vector<std::filesystem::path> files = results(others);
  if (frames && holds_frames(file("frames"))) files.push_back(file("frames"));
  return files;
}

bool RunFolder::has_begun() const {
  std::error_code ignored;
  return std::filesystem::exists(checkpoint(), ignored) || std::filesystem::exists(file("frames"), ignored);
}

void RunFolder::remove_checkpoints() const noexcept {
  std::error_code ignored;
  std::filesystem::remove(checkpoint(), ignored);
  std::filesystem::remove(half_speed_checkpoint(), ignored);
}

void RunFolder::remove_results(const std::vector<std::string>& others) const {
  for (const std::filesystem::path& result : results(others)) {
    std::error_code error;
    if (!std::filesystem::remove(result, error) && error) throw cannot_be_removed(result, error);
  }
}

void RunFolder::write(const nlohmann::ordered_json& result) const {
  const Machine machine = this_machine();
  nlohmann::ordered_json run;
  run["version"] = version;
  run["commit"] = commit;
  run["command_line"] = invocation.arguments;
  run["inputs"] = inputs;
  run["seeds"] = seeds;
  run["threads"] = threads;
  run["machine"] = {{"cpu", machine.cpu},
                    {"cores", machine.cores},
                    {"memory_bytes", static_cast<std::uint64_t>(machine.memory)},
                    {"kernel", machine.kernel},
                    {"arch", machine.arch}};
  run["start"] = invocation.started;
  run["end"] = utc_now();
  // Bytes of a path that are no UTF-8 must not make a finished run fail.
  const auto text = [](const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  };
  dem::write_file_atomically(file("run.json"), text(run));
  dem::write_file_atomically(file("result.json"), text(result));
}

}  // namespace app
