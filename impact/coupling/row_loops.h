// The loops over rows of four as each instruction set compiles them. Use node_factor.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

namespace coupling {

/// The passes over tied elements, cells [begin, end): elements in one finite element share its eight nodes.
/// Plain pointers, so that code compiled for a wide machine meets no template of a library. Vectors are rows of
/// four doubles, the last unused.
struct CellPass {
  const std::int32_t* cell_first;
  const std::int32_t* cell_nodes;
  const double* shape;
  const double* nodes;          ///< the nodes' velocities, before and after
  const std::int32_t* element;  ///< numbers of the tied elements
  double* velocity;             ///< of element i at velocity + stride * i
  std::size_t stride;
  const double* mass;    ///< by tied element and axis; 0 where not tied
  const double* factor;  ///< what makes an impulse of the violation, by tied element and axis
  double* violation;     ///< r = v - k u, by tied element; null: not kept
  double* cell_impulse;  ///< k^T factor r of each cell, eight rows a cell
  const double* own;     ///< null: velocities become k u; else they lose own r, by tied element and axis
  double part;           ///< of the change that is made, 1/p
  std::size_t begin, end;
  double energy_change;      ///< out: twice that of the kinetic energy [J]
  double max_speed_squared;  ///< out [m2/s2]
};

struct RowLoops {
  /// result = A x for rows [begin, end) of a matrix stored row by row.
  void (*multiply)(const std::int32_t* first, const std::int32_t* column, const double* value, const double* x,
                   double* result, std::size_t begin, std::size_t end);
  /// x = (L L^T)^-1 x; L column by column below its diagonal.
  void (*solve)(const std::int32_t* first, const std::int32_t* row, const double* value,
                const double* inverse_diagonal, std::size_t size, double* x);
  /// Fills cell_impulse, and violation where it is kept.
  void (*violation)(CellPass&);
  /// Changes the velocities.
  void (*correct)(CellPass&);
};

RowLoops baseline_row_loops();
#ifdef SPALL_X86
RowLoops avx2_row_loops();
RowLoops avx512_row_loops();
#endif

/// Those for this machine.
const RowLoops& row_loops();

}  // namespace coupling
