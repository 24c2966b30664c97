// The loops that find the machine's ceilings, compiled once per instruction set.
#include "bench/machine.h"
#include "libdem/core/lanes.h"

namespace bench {
namespace {

void triad(double* __restrict a, const double* __restrict b, const double* __restrict c, double s,
           std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + s * c[k];
}

void update(double* __restrict a, const double* __restrict b, double s, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) a[k] += s * b[k];
}

constexpr int chains = 12;  // independent, to hide the latency of one

double multiply_add(std::size_t rounds) {
  using dem::Lanes;
  const Lanes factor = dem::broadcast<Lanes>(0.999999), add = dem::broadcast<Lanes>(1e-9);
  Lanes x[chains];
  for (int k = 0; k < chains; ++k) x[k] = dem::broadcast<Lanes>(1.0 + k);
  for (std::size_t r = 0; r < rounds; ++r)
    for (Lanes& one : x) one = one * factor + add;
  double total = 0;
  for (const Lanes& one : x) total += dem::sum(one);
  return total;
}

}  // namespace

MachineLoops SPALL_JOIN(SPALL_ISA, _machine_loops)() {
  return {triad, update, multiply_add, std::size_t{2} * chains * dem::lane_count};
}

}  // namespace bench
