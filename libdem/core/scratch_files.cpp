#include "libdem/core/scratch_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace dem {
namespace {

std::string host_name() {
  char name[256] = "";
  return ::gethostname(name, sizeof name - 1) == 0 && name[0] != 0 ? name : "host";
}

/// Whether a file of that name was left by a process of this machine that has ended. This process's own number
/// counts as ended: nothing is being written while one sweeps, and in a container numbers come again.
bool is_left_over(const std::string& name, const std::string& host) {
  constexpr std::string_view ending = ".part";
  if (!name.starts_with('.') || !name.ends_with(ending)) return false;
  const std::string rest = name.substr(0, name.size() - ending.size());
  const std::size_t dot = rest.rfind('.');
  if (dot == 0 || !rest.substr(0, dot).ends_with("." + host)) return false;
  int process = 0;
  const char* const last = rest.data() + rest.size();
  const auto [end, error] = std::from_chars(rest.data() + dot + 1, last, process);
  if (error != std::errc{} || end != last || process <= 0) return false;
  return process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH);
}

}  // namespace

std::filesystem::path scratch_path(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".{}.{}.{}.part", file.filename().string(), host_name(), ::getpid());
}

void sweep_scratch(const std::filesystem::path& folder) {
  const std::string host = host_name();
  std::error_code error, ignored;
  std::vector<std::filesystem::path> left;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_left_over(entry->path().filename().string(), host)) left.push_back(entry->path());
  for (const std::filesystem::path& file : left) std::filesystem::remove_all(file, ignored);
}

}  // namespace dem
