// The loops over rows of four, compiled once per instruction set.
#include "impact/coupling/row_loops.h"

#include "libdem/core/lanes.h"

namespace coupling {
inline namespace SPALL_ISA {
namespace {

using Four = double __attribute__((vector_size(32)));

SPALL_INLINE Four load_four(const double* from) {
  Four four;
  __builtin_memcpy(&four, from, sizeof four);
  return four;
}
SPALL_INLINE void store_four(double* to, Four four) { __builtin_memcpy(to, &four, sizeof four); }

void multiply_rows(const std::int32_t* first, const std::int32_t* column, const double* value, const double* x,
                   double* result, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    Four sum{};
    for (std::int32_t p = first[i]; p < first[i + 1]; ++p)
      sum += value[p] * load_four(x + 4 * static_cast<std::size_t>(column[p]));
    store_four(result + 4 * i, sum);
  }
}

void solve_rows(const std::int32_t* first, const std::int32_t* row, const double* value,
                const double* inverse_diagonal, std::size_t size, double* x) {
  for (std::size_t j = 0; j < size; ++j) {
    const Four known = load_four(x + 4 * j) * inverse_diagonal[j];
    store_four(x + 4 * j, known);
    for (std::int32_t p = first[j]; p < first[j + 1]; ++p) {
      double* other = x + 4 * static_cast<std::size_t>(row[p]);
      store_four(other, load_four(other) - value[p] * known);
    }
  }
  for (std::size_t j = size; j-- > 0;) {
    // Two sums, so that additions need not wait for each other.
    Four even{}, odd{};
    std::int32_t p = first[j];
    for (; p + 1 < first[j + 1]; p += 2) {
      even += value[p] * load_four(x + 4 * static_cast<std::size_t>(row[p]));
      odd += value[p + 1] * load_four(x + 4 * static_cast<std::size_t>(row[p + 1]));
    }
    if (p < first[j + 1]) even += value[p] * load_four(x + 4 * static_cast<std::size_t>(row[p]));
    store_four(x + 4 * j, (load_four(x + 4 * j) - (even + odd)) * inverse_diagonal[j]);
  }
}

}  // namespace
}  // namespace SPALL_ISA

RowLoops SPALL_JOIN(SPALL_ISA, _row_loops)() { return {SPALL_ISA::multiply_rows, SPALL_ISA::solve_rows}; }

}  // namespace coupling
