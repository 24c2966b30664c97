// A sparse Cholesky factor that solves for three right-hand sides at once, one a spatial axis.
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/aligned.h"

namespace coupling {

/// Three numbers and one unused: a vector of the machine.
struct alignas(32) Row {
  double value[4] = {};
};

/// result[i] = sum over the entries of row i of matrix * x, the sum in the order of the columns.
void multiply(const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& matrix, std::span<const Row> x,
              std::span<Row> result, int threads);

/// P = L L^T of a symmetric positive definite matrix, unknowns reordered for little fill.
class NodeFactor {
 public:
  /// Throws RunError if the matrix is not positive definite.
  explicit NodeFactor(const Eigen::SparseMatrix<double>& matrix);

  /// x = P^-1 x, for all the columns of the rows; `work` is room that is kept between calls.
  void solve(std::span<Row> x, dem::Column<Row>& work) const;
  std::size_t entries() const { return value.size(); }

 private:
  std::vector<std::int32_t> order;       ///< where unknown i of the factor is in x
  std::vector<std::int32_t> first, row;  ///< below the diagonal, column by column
  std::vector<double> value, inverse_diagonal;
};

}  // namespace coupling
