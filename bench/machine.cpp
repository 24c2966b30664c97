#include "bench/machine.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "bench/turns.h"
#include "libdem/core/instructions.h"

namespace bench {
namespace {

MachineLoops chosen_loops() {
  return dem::choose_instructions(baseline_machine_loops
#ifdef SPALL_X86
                                  ,
                                  avx2_machine_loops, avx512_machine_loops
#endif
  );
}

MemoryLevel measure_level(const MachineLoops& loops, std::string name, std::size_t bytes, int turns) {
  MemoryLevel level{std::move(name), bytes, 0, 0};
  const std::size_t count = bytes / (3 * sizeof(double));
  std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  // Long enough for the clock: at least 24 MB a turn.
  const auto passes = std::max<std::size_t>(1, 24'000'000 / (24 * count));
  const double moved = 24.0 * static_cast<double>(count * passes);
  for (int turn = 0; turn < turns; ++turn) {
    level.triad = std::max(level.triad, moved / own_seconds_of([&] {
                                          for (std::size_t p = 0; p < passes; ++p)
                                            loops.triad(a.data(), b.data(), c.data(), 3.0, count);
                                        }));
    // Two arrays of the same working set in all.
    level.update =
        std::max(level.update, moved / own_seconds_of([&] {
                                 for (std::size_t p = 0; p < passes; ++p)
                                   loops.update(p % 2 == 0 ? a.data() : c.data(), b.data(), 1e-9, count);
                               }));
  }
  return level;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown processor";
}

}  // namespace

const MemoryLevel& Machine::level_for(double bytes) const {
  for (const MemoryLevel& level : levels)
    if (bytes <= 2.0 * static_cast<double>(level.bytes)) return level;
  return levels.back();
}

Machine measure_machine(bool quick) {
  const MachineLoops loops = chosen_loops();
  Machine machine;
  machine.instructions = std::string(dem::name_of(dem::instructions()));
  machine.processor = processor_name();
  const int turns = quick ? 5 : 15;
  // Sizes well inside L2 (1 MB or more) and L3, and well outside.
  machine.levels.push_back(measure_level(loops, "L2", 600'000, 4 * turns));
  machine.levels.push_back(measure_level(loops, "L3", 12'000'000, 2 * turns));
  machine.levels.push_back(measure_level(loops, "memory", 600'000'000, turns));
  constexpr std::size_t rounds = 4'000'000;
  volatile double sink = 0;
  for (int turn = 0; turn < turns; ++turn)
    machine.operations =
        std::max(machine.operations, static_cast<double>(rounds * loops.operations_per_round) /
                                         own_seconds_of([&] { sink = sink + loops.multiply_add(rounds); }));
  return machine;
}

}  // namespace bench
