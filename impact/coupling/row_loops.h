// The loops over rows of four as each instruction set compiles them. Use node_factor.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

namespace coupling {

/// Plain pointers, so that code compiled for a wide machine meets no template of a library. Vectors are rows of
/// four doubles.
struct RowLoops {
  /// result = A x for rows [begin, end) of a matrix stored row by row.
  void (*multiply)(const std::int32_t* first, const std::int32_t* column, const double* value, const double* x,
                   double* result, std::size_t begin, std::size_t end);
  /// x = (L L^T)^-1 x; L column by column below its diagonal.
  void (*solve)(const std::int32_t* first, const std::int32_t* row, const double* value,
                const double* inverse_diagonal, std::size_t size, double* x);
};

RowLoops baseline_row_loops();
#ifdef SPALL_X86
RowLoops avx2_row_loops();
RowLoops avx512_row_loops();
#endif

}  // namespace coupling
