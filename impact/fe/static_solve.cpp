#include "impact/fe/static_solve.h"

#include <Eigen/SparseCholesky>

#include "libdem/core/error.h"

namespace fe {

Eigen::SparseMatrix<double> assemble(const Body& body) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(576 * body.elements());
  for (std::size_t e = 0; e < body.elements(); ++e) {
    const ElementMatrix& k = body.element_stiffness(e);
    const Hexahedron& node = body.connectivity[e];
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i)
        entries.emplace_back(3 * node[static_cast<std::size_t>(i / 3)] + i % 3,
                             3 * node[static_cast<std::size_t>(j / 3)] + j % 3, k(i, j));
  }
  const auto size = static_cast<Eigen::Index>(3 * body.nodes());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

StaticSolution solve_static(const Body& body, std::span<const Vec3> load, std::span<const Held> held,
                            std::span<const Vec3> prescribed) {
  const Eigen::SparseMatrix<double> whole = assemble(body);
  const Eigen::Index size = whole.rows();
  std::vector<Eigen::Index> place(static_cast<std::size_t>(size), -1);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(size), f(size);
  Eigen::Index free = 0;
  for (std::size_t i = 0; i < body.nodes(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t dof = 3 * i + c;
      f[static_cast<Eigen::Index>(dof)] = load[i][static_cast<Eigen::Index>(c)];
      if (held[i][c])
        u[static_cast<Eigen::Index>(dof)] = prescribed[i][static_cast<Eigen::Index>(c)];
      else if (body.node_mass[i] > 0)
        place[dof] = free++;
    }
  const Eigen::VectorXd rest = f - whole * u;
  Eigen::VectorXd right(free);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(whole.nonZeros()));
  for (Eigen::Index column = 0; column < size; ++column) {
    const Eigen::Index j = place[static_cast<std::size_t>(column)];
    if (j < 0) continue;
    right[j] = rest[column];
    for (Eigen::SparseMatrix<double>::InnerIterator it(whole, column); it; ++it)
      if (const Eigen::Index i = place[static_cast<std::size_t>(it.row())]; i >= 0)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), it.value());
  }
  Eigen::SparseMatrix<double> matrix(free, free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  // A free motion leaves a pivot that is rounding only.
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-12 * solver.vectorD().maxCoeff()))
    throw dem::RunError("the supports leave the finite elements free to move: lock more degrees of freedom");
  Eigen::VectorXd found = solver.solve(right);
  found += solver.solve(right - matrix * found);  // one refinement takes out the factorisation's rounding
  for (std::size_t dof = 0; dof < place.size(); ++dof)
    if (place[dof] >= 0) u[static_cast<Eigen::Index>(dof)] = found[place[dof]];
  const Eigen::VectorXd reaction = whole * u - f;
  StaticSolution solution;
  for (Eigen::Index i = 0; i < size; i += 3) {
    solution.displacement.emplace_back(u.segment<3>(i));
    solution.reaction.emplace_back(reaction.segment<3>(i));
  }
  return solution;
}

}  // namespace fe
