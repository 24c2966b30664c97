// What the machine gives one core: bytes a second from each level of memory, operations a second. Measured in
// the run that needs it, since neighbours on a shared machine take their part.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace bench {

/// Compiled once per instruction set.
struct MachineLoops {
  /// a = b + s c: reads two arrays, writes a third.
  void (*triad)(double* a, const double* b, const double* c, double s, std::size_t count);
  /// a = a + s b: reads two arrays, writes one of them back, as the step does with its histories.
  void (*update)(double* a, const double* b, double s, std::size_t count);
  /// Runs so many fused multiply-adds (each counts as two operations) in registers; returns what came out.
  double (*multiply_add)(std::size_t rounds);
  std::size_t operations_per_round;
};
MachineLoops baseline_machine_loops();
#ifdef SPALL_X86
MachineLoops avx2_machine_loops();
MachineLoops avx512_machine_loops();
#endif

/// One level of memory: a working set of `bytes` in all, and the rates that it sustains [bytes/s]. 24 bytes
/// count per element of either loop, as in STREAM: what a cache fetches before it overwrites a line is not
/// counted.
struct MemoryLevel {
  std::string name;
  std::size_t bytes = 0;
  double triad = 0, update = 0;
  double bandwidth() const { return triad > update ? triad : update; }
};

struct Machine {
  std::vector<MemoryLevel> levels;  ///< from the nearest to the farthest
  double operations = 0;            ///< double precision, a second
  std::string instructions;         ///< the set that both were measured with
  std::string processor;            ///< as the system names it

  /// The level that a working set of so many bytes runs from.
  const MemoryLevel& level_for(double bytes) const;
};

/// Best of several turns each: a ceiling.
Machine measure_machine(bool quick);

}  // namespace bench
