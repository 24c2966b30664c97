#include "impact/coupling/multipliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace coupling {
namespace {

/// M_u + k^T M_d k of one axis; a locked node keeps its own row and column alone.
Eigen::SparseMatrix<double> node_matrix(const RowMatrix& k, const dem::Column<Row>& element_mass,
                                        const dem::Column<Row>& node_mass, std::span<const double> plain_mass,
                                        std::size_t axis) {
  Eigen::VectorXd masses(k.rows());
  for (Eigen::Index i = 0; i < k.rows(); ++i) masses[i] = element_mass[static_cast<std::size_t>(i)].value[axis];
  RowMatrix moving = k;
  for (Eigen::Index i = 0; i < moving.rows(); ++i)
    for (RowMatrix::InnerIterator it(moving, i); it; ++it)
      if (node_mass[static_cast<std::size_t>(it.col())].value[axis] == 0) it.valueRef() = 0;
  Eigen::SparseMatrix<double> matrix = RowMatrix(moving.transpose()) * RowMatrix(masses.asDiagonal() * moving);
  for (Eigen::Index j = 0; j < matrix.rows(); ++j)
    matrix.coeffRef(j, j) += plain_mass[static_cast<std::size_t>(j)];
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

Multipliers::Multipliers(const KinematicMap& map, const DiscreteMasses& masses, const fe::State& nodes,
                         const TieOptions& wanted)
    : ties(map), options(wanted), k_transposed(map.k.transpose()) {
  const std::size_t count = ties.elements.size(), node_count = ties.nodes.size();
  const bool rotations = ties.ties == Ties::displacements_and_rotations;
  if (options.solve == MultiplierSolve::lumped && rotations)
    throw dem::InputError("coupling", "lumped multipliers and tied rotations were both asked for",
                          "lumped multipliers tie displacements only");
  if (!(options.relaxation_time >= 0))
    throw dem::InputError("coupling", fmt::format("the relaxation time is {:g} s", options.relaxation_time),
                          "it must be 0 (strict) or above");
  if (masses.row.size() != count)
    throw dem::InputError("coupling",
                          fmt::format("masses of {} elements for {} ties", masses.row.size(), count),
                          "one row for each tied element");
  element_mass.resize(count), element_inertia.resize(count), element_velocity.resize(count);
  violation.resize(count), impulse.resize(count), element_change.resize(count), lumped.resize(count);
  element_spin.resize(count), spin_change.resize(count);
  node_mass.resize(node_count), node_velocity.resize(node_count), node_change.resize(node_count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      element_mass[i].value[c] = masses.row[i][c];
      element_inertia[i].value[c] = masses.row[i][c + 3];
    }
  std::vector<double> plain_mass;
  for (std::size_t j = 0; j < node_count; ++j) {
    const auto node = static_cast<std::size_t>(ties.nodes[j]);
    plain_mass.push_back(nodes.mass[node]);
    for (std::size_t c = 0; c < 3; ++c)
      node_mass[j].value[c] = nodes.inverse_mass[node][static_cast<Eigen::Index>(c)] > 0 ? nodes.mass[node] : 0;
  }

  if (options.solve == MultiplierSolve::lumped) {
    lump();
    return;
  }
  if (rotations) {
    const auto size = static_cast<Eigen::Index>(3 * node_count);
    std::vector<Eigen::Triplet<double, std::int32_t>> entries;
    Eigen::VectorXd weight(static_cast<Eigen::Index>(6 * count));
    const auto add = [&](std::int32_t row, std::int32_t column, double value) {
      if (node_mass[static_cast<std::size_t>(column / 3)].value[column % 3] > 0)
        entries.emplace_back(row, column, value);
    };
    const auto rows = static_cast<std::int32_t>(count);
    for (std::int32_t i = 0; i < rows; ++i)
      for (std::int32_t c = 0; c < 3; ++c) {
        weight[3 * i + c] = element_mass[static_cast<std::size_t>(i)].value[c];
        weight[3 * (rows + i) + c] = element_inertia[static_cast<std::size_t>(i)].value[c];
        for (RowMatrix::InnerIterator it(ties.k, i); it; ++it)
          add(3 * i + c, static_cast<std::int32_t>(3 * it.col()) + c, it.value());
        for (RowMatrix::InnerIterator it(ties.h, 3 * i + c); it; ++it)
          add(3 * (rows + i) + c, static_cast<std::int32_t>(it.col()), it.value());
      }
    RowMatrix both(static_cast<Eigen::Index>(6 * count), size);
    both.setFromTriplets(entries.begin(), entries.end());
    WholeMatrix matrix = RowMatrix(both.transpose()) * RowMatrix(weight.asDiagonal() * both);
    for (Eigen::Index j = 0; j < size; ++j)
      matrix.coeffRef(j, j) += plain_mass[static_cast<std::size_t>(j / 3)];
    whole = std::make_unique<Eigen::SimplicialLLT<WholeMatrix>>(matrix);
    if (whole->info() != Eigen::Success)
      throw dem::RunError(
          "the multipliers' matrix is not positive definite: a node of the overlap has no mass");
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto same = [&](const AxisGroup& group) {
      const auto other =
          static_cast<std::size_t>(std::find(group.axes.begin(), group.axes.end(), true) - group.axes.begin());
      const auto equal = [&](const Row& row) { return row.value[axis] == row.value[other]; };
      return std::all_of(element_mass.begin(), element_mass.end(), equal) &&
             std::all_of(node_mass.begin(), node_mass.end(), equal);
    };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) {
      groups.push_back(
          {{}, std::make_shared<NodeFactor>(node_matrix(ties.k, element_mass, node_mass, plain_mass, axis))});
      group = groups.end() - 1;
    }
    group->axes[axis] = true;
  }
}

void Multipliers::lump() {
  // Row sums of C M^-1 C^T = M_d^-1 + k M_u^-1 k^T; k is not negative, so they bound its highest eigenvalue.
  dem::Column<Row> one(ties.elements.size()), share(ties.nodes.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) one[i].value[c] = element_mass[i].value[c] > 0 ? 1 : 0;
  multiply(k_transposed, one, share, 1);
  for (std::size_t j = 0; j < share.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c)
      share[j].value[c] = node_mass[j].value[c] > 0 ? share[j].value[c] / node_mass[j].value[c] : 0;
  multiply(ties.k, share, lumped, 1);
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (one[i].value[c] > 0) lumped[i].value[c] += 1 / element_mass[i].value[c];
}

std::size_t Multipliers::factor_entries() const {
  std::size_t sum = 0;
  for (const AxisGroup& group : groups) sum += group.factor->entries();
  if (whole) {
    const WholeMatrix lower = whole->matrixL();
    sum += static_cast<std::size_t>(lower.nonZeros());
  }
  return sum;
}

void Multipliers::read_velocities(DiscreteVelocities discrete, const fe::State& nodes) {
  for (std::size_t j = 0; j < node_velocity.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c)
      node_velocity[j].value[c] =
          nodes.velocity[static_cast<std::size_t>(ties.nodes[j])][static_cast<Eigen::Index>(c)];
  multiply(ties.k, node_velocity, violation, options.threads);
  for (std::size_t i = 0; i < violation.size(); ++i) {
    const double* v = discrete.row(ties.elements[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      element_velocity[i].value[c] = v[c];
      element_spin[i].value[c] = v[c + 3];
      violation[i].value[c] = v[c] - violation[i].value[c];
      impulse[i].value[c] = element_mass[i].value[c] * violation[i].value[c];
    }
  }
}

void Multipliers::solve_displacements() {
  if (options.solve == MultiplierSolve::lumped) {
    for (std::size_t i = 0; i < impulse.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const bool tied = element_mass[i].value[c] > 0;
        impulse[i].value[c] = tied ? violation[i].value[c] / lumped[i].value[c] : 0;  // lambda
        element_change[i].value[c] = tied ? -impulse[i].value[c] / element_mass[i].value[c] : 0;
      }
    multiply(k_transposed, impulse, node_change, options.threads);
    for (std::size_t j = 0; j < node_change.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c)
        node_change[j].value[c] =
            node_mass[j].value[c] > 0 ? node_change[j].value[c] / node_mass[j].value[c] : 0;
    return;
  }
  multiply(k_transposed, impulse, node_change, options.threads);
  for (std::size_t j = 0; j < node_change.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c)
      if (node_mass[j].value[c] == 0) node_change[j].value[c] = 0;
  if (groups.size() == 1) {
    groups.front().factor->solve(node_change, work);
  } else {
    const dem::Column<Row> right = node_change;
    dem::Column<Row> found(right.size());
    for (const AxisGroup& group : groups) {
      found = right;
      group.factor->solve(found, work);
      for (std::size_t j = 0; j < found.size(); ++j)
        for (std::size_t c = 0; c < 3; ++c)
          if (group.axes[c]) node_change[j].value[c] = found[j].value[c];
    }
  }
  multiply(ties.k, node_change, element_change, options.threads);
  for (std::size_t i = 0; i < element_change.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      element_change[i].value[c] =
          element_mass[i].value[c] > 0 ? element_change[i].value[c] - violation[i].value[c] : 0;
}

void Multipliers::solve_with_rotations() {
  const auto count = static_cast<Eigen::Index>(ties.elements.size()),
             nodes = static_cast<Eigen::Index>(ties.nodes.size());
  const auto axes_of = [](const dem::Column<Row>& rows, Eigen::Index size) {
    Eigen::VectorXd flat(3 * size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index c = 0; c < 3; ++c) flat[3 * i + c] = rows[static_cast<std::size_t>(i)].value[c];
    return flat;
  };
  const Eigen::VectorXd spin_violation = axes_of(element_spin, count) - ties.h * axes_of(node_velocity, nodes);
  multiply(k_transposed, impulse, node_change, options.threads);
  Eigen::VectorXd right =
      axes_of(node_change, nodes) +
      Eigen::VectorXd(ties.h.transpose() * axes_of(element_inertia, count).cwiseProduct(spin_violation));
  const Eigen::VectorXd masses = axes_of(node_mass, nodes);
  for (Eigen::Index j = 0; j < right.size(); ++j)
    if (masses[j] == 0) right[j] = 0;
  const Eigen::VectorXd q = whole->solve(right);
  const Eigen::VectorXd spin = ties.h * q - spin_violation;
  for (Eigen::Index j = 0; j < nodes; ++j)
    for (Eigen::Index c = 0; c < 3; ++c) node_change[static_cast<std::size_t>(j)].value[c] = q[3 * j + c];
  multiply(ties.k, node_change, element_change, options.threads);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto e = static_cast<std::size_t>(i);
    for (std::size_t c = 0; c < 3; ++c) {
      element_change[e].value[c] =
          element_mass[e].value[c] > 0 ? element_change[e].value[c] - violation[e].value[c] : 0;
      spin_change[e].value[c] =
          element_inertia[e].value[c] > 0 ? spin[3 * i + static_cast<Eigen::Index>(c)] : 0;
    }
  }
}

TieSums Multipliers::apply(DiscreteVelocities discrete, fe::State& nodes, double time_step) {
  read_velocities(discrete, nodes);
  const bool rotations = whole != nullptr;
  if (rotations)
    solve_with_rotations();
  else
    solve_displacements();
  const double part = options.relaxation_time > time_step ? time_step / options.relaxation_time : 1;  // 1/p
  TieSums sums;
  double change = 0;  // twice the kinetic energy's
  const auto add = [&](double mass, double& velocity, double by) {
    const double after = velocity + part * by;
    change += mass * (after * after - velocity * velocity);
    velocity = after;
  };
  for (std::size_t i = 0; i < ties.elements.size(); ++i) {
    double* v = discrete.row(ties.elements[i]);
    for (std::size_t c = 0; c < 3; ++c) add(element_mass[i].value[c], v[c], element_change[i].value[c]);
    if (rotations)
      for (std::size_t c = 0; c < 3; ++c) add(element_inertia[i].value[c], v[c + 3], spin_change[i].value[c]);
    sums.max_speed_squared = std::max(sums.max_speed_squared, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  for (std::size_t j = 0; j < ties.nodes.size(); ++j) {
    Vec3& v = nodes.velocity[static_cast<std::size_t>(ties.nodes[j])];
    for (std::size_t c = 0; c < 3; ++c)
      add(node_mass[j].value[c], v[static_cast<Eigen::Index>(c)], node_change[j].value[c]);
  }
  sums.kinetic_change = 0.5 * change;
  return sums;
}

}  // namespace coupling
