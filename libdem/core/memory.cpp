#include "libdem/core/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "libdem/core/error.h"

namespace dem {
namespace {

std::optional<double> number_in(const char* file) {
  double number = 0;
  if (std::ifstream in(file); in >> number) return number;  // "max" is no number: no limit
  return {};
}

double of_the_machine() {
  std::ifstream in("/proc/meminfo");
  for (std::string name, unit; in >> name;) {
    double kilobytes = 0;
    in >> kilobytes;
    std::getline(in, unit);
    if (name == "MemAvailable:") return 1024 * kilobytes;
  }
  return std::numeric_limits<double>::infinity();
}

/// Of what the group uses, the copies of files that the system drops when memory is wanted.
double files_kept_in_memory() {
  std::ifstream in("/sys/fs/cgroup/memory.stat");
  double bytes = 0, number = 0;
  for (std::string name; in >> name >> number;)
    if (name == "active_file" || name == "inactive_file") bytes += number;
  return bytes;
}

double of_the_control_group() {
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (!limit || !used) return std::numeric_limits<double>::infinity();
  return std::max(0.0, *limit - std::max(0.0, *used - files_kept_in_memory()));
}

/// What little work needs is not what a full machine lacks.
constexpr double never_refused = 64e6;

}  // namespace

double available_memory() {
  const double bytes = std::min(of_the_machine(), of_the_control_group());
  return bytes < std::numeric_limits<double>::infinity() ? 0.9 * bytes : 1e9;
}

void require_memory(double bytes, const std::string& where, const std::string& what) {
  if (bytes < never_refused) return;
  const double there = available_memory();
  if (bytes > there)
    throw InputError(
        where,
        fmt::format("{} needs about {:.3g} GB of memory, {:.3g} GB are free", what, 1e-9 * bytes, 1e-9 * there),
        "take fewer elements, or a machine with more memory");
}

}  // namespace dem
