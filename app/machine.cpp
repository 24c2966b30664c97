#include "app/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>

namespace app {

Machine this_machine() {
  Machine machine;
  machine.cpu = machine.kernel = machine.arch = "unknown";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0 && line.find(':') != std::string::npos) {
      const auto begin = line.find_first_not_of(" \t", line.find(':') + 1);
      if (begin != std::string::npos) machine.cpu = line.substr(begin);
      break;
    }
  machine.cores = static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
  machine.memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (utsname name{}; ::uname(&name) == 0) {
    machine.kernel = std::string(name.sysname) + " " + name.release;
    machine.arch = name.machine;
  }
  return machine;
}

}  // namespace app
