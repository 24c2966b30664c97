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

/// Row i of a matrix times x.
SPALL_INLINE Four row_times(const std::int32_t* first, const std::int32_t* column, const double* value,
                            const double* x, std::size_t i) {
  Four even{}, odd{};  // two sums, so that additions need not wait for each other
  std::int32_t p = first[i];
  for (; p + 1 < first[i + 1]; p += 2) {
    even += value[p] * load_four(x + 4 * static_cast<std::size_t>(column[p]));
    odd += value[p + 1] * load_four(x + 4 * static_cast<std::size_t>(column[p + 1]));
  }
  if (p < first[i + 1]) even += value[p] * load_four(x + 4 * static_cast<std::size_t>(column[p]));
  return even + odd;
}

void multiply_rows(const std::int32_t* first, const std::int32_t* column, const double* value, const double* x,
                   double* result, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) store_four(result + 4 * i, row_times(first, column, value, x, i));
}

/// The eight nodes of a cell.
struct CellRows {
  Four row[8];
};

SPALL_INLINE CellRows gather(const CellPass& pass, std::size_t cell) {
  CellRows rows;
  for (std::size_t a = 0; a < 8; ++a)
    rows.row[a] = load_four(pass.nodes + 4 * static_cast<std::size_t>(pass.cell_nodes[8 * cell + a]));
  return rows;
}

/// The cell's field at one tied element.
SPALL_INLINE Four field(const CellRows& rows, const double* shape) {
  const Four low =
      shape[0] * rows.row[0] + shape[1] * rows.row[1] + shape[2] * rows.row[2] + shape[3] * rows.row[3];
  const Four high =
      shape[4] * rows.row[4] + shape[5] * rows.row[5] + shape[6] * rows.row[6] + shape[7] * rows.row[7];
  return low + high;
}

void find_violation(CellPass& pass) {
  for (std::size_t cell = pass.begin; cell < pass.end; ++cell) {
    const CellRows nodes = gather(pass, cell);
    CellRows sum{};
    for (auto i = static_cast<std::size_t>(pass.cell_first[cell]);
         i < static_cast<std::size_t>(pass.cell_first[cell + 1]); ++i) {
      const double* v = pass.velocity + pass.stride * static_cast<std::size_t>(pass.element[i]);
      const double* shape = pass.shape + 8 * i;
      const Four violation = load_four(v) - field(nodes, shape);
      const Four impulse = load_four(pass.factor + 4 * i) * violation;
      if (pass.violation != nullptr) store_four(pass.violation + 4 * i, violation);
      for (int a = 0; a < 8; ++a) sum.row[a] += shape[a] * impulse;
    }
    for (std::size_t a = 0; a < 8; ++a) store_four(pass.cell_impulse + 32 * cell + 4 * a, sum.row[a]);
  }
}

void correct_velocities(CellPass& pass) {
  const Four zero{};
  Four energy{};
  double fastest = 0;
  for (std::size_t cell = pass.begin; cell < pass.end; ++cell) {
    const CellRows nodes = gather(pass, cell);
    for (auto i = static_cast<std::size_t>(pass.cell_first[cell]);
         i < static_cast<std::size_t>(pass.cell_first[cell + 1]); ++i) {
      double* v = pass.velocity + pass.stride * static_cast<std::size_t>(pass.element[i]);
      const Four mass = load_four(pass.mass + 4 * i), before = load_four(v);
      // k q - r = k (u + q) - v: the nodes' new velocities say it all.
      const Four change = pass.own != nullptr ? -load_four(pass.own + 4 * i) * load_four(pass.violation + 4 * i)
                                              : field(nodes, pass.shape + 8 * i) - before;
      const Four after = before + (mass > zero ? pass.part * change : zero);
      energy += mass * (after * after - before * before);
      for (int c = 0; c < 3; ++c) v[c] = after[c];
      const double speed = after[0] * after[0] + after[1] * after[1] + after[2] * after[2];
      fastest = speed > fastest ? speed : fastest;
    }
  }
  pass.energy_change = energy[0] + energy[1] + energy[2];
  pass.max_speed_squared = fastest;
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
    const Four known = row_times(first, row, value, x, j);
    store_four(x + 4 * j, (load_four(x + 4 * j) - known) * inverse_diagonal[j]);
  }
}

}  // namespace
}  // namespace SPALL_ISA

RowLoops SPALL_JOIN(SPALL_ISA, _row_loops)() {
  return {SPALL_ISA::multiply_rows, SPALL_ISA::solve_rows, SPALL_ISA::find_violation,
          SPALL_ISA::correct_velocities};
}

}  // namespace coupling
