#include "impact/coupling/node_factor.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "impact/coupling/row_loops.h"
#include "libdem/core/error.h"
#include "libdem/core/instructions.h"

namespace coupling {
namespace {

constexpr std::size_t rows_per_block = 256;

}  // namespace

const RowLoops& row_loops() {
  static const RowLoops chosen = dem::choose_instructions(baseline_row_loops
#ifdef SPALL_X86
                                                          ,
                                                          avx2_row_loops, avx512_row_loops
#endif
  );
  return chosen;
}

void multiply(const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& matrix, std::span<const Row> x,
              std::span<Row> result, int threads) {
  const auto rows = static_cast<std::size_t>(matrix.rows());
  const std::size_t blocks = (rows + rows_per_block - 1) / rows_per_block;
  const RowLoops& loops = row_loops();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t block = 0; block < blocks; ++block)
    loops.multiply(matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(), x.front().value,
                   result.front().value, block * rows_per_block, std::min(rows, (block + 1) * rows_per_block));
}

NodeFactor::NodeFactor(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw dem::RunError("the multipliers' matrix is not positive definite: a node of the overlap has no mass");
  const Eigen::SparseMatrix<double> lower = solver.matrixL();
  const Eigen::Index size = lower.rows();
  order.resize(static_cast<std::size_t>(size));
  for (Eigen::Index i = 0; i < size; ++i)  // P maps unknown i of the matrix to indices()[i] of the factor
    order[static_cast<std::size_t>(solver.permutationP().indices()[i])] = static_cast<std::int32_t>(i);
  first.push_back(0);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it) {
      if (it.row() == j) {
        inverse_diagonal.push_back(1 / it.value());
      } else {
        row.push_back(static_cast<std::int32_t>(it.row()));
        value.push_back(it.value());
      }
    }
    first.push_back(static_cast<std::int32_t>(row.size()));
  }
}

void NodeFactor::solve(std::span<Row> x, dem::Column<Row>& work) const {
  const std::size_t size = order.size();
  work.resize(size);
  for (std::size_t i = 0; i < size; ++i) work[i] = x[static_cast<std::size_t>(order[i])];
  row_loops().solve(first.data(), row.data(), value.data(), inverse_diagonal.data(), size, work.front().value);
  for (std::size_t i = 0; i < size; ++i) x[static_cast<std::size_t>(order[i])] = work[i];
}

}  // namespace coupling
