#include "impact/coupling/multipliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace coupling {
namespace {

constexpr std::size_t cells_per_block = 16;

/// rows /= mass; 0 where a motion is locked.
void divide_by_mass(dem::Column<Row>& rows, const dem::Column<Row>& mass) {
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c)
      rows[j].value[c] = mass[j].value[c] > 0 ? rows[j].value[c] / mass[j].value[c] : 0;
}

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
    : ties(map), options(wanted) {
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
  for (dem::Column<Row>* column : {&element_mass, &element_inertia}) column->resize(count);
  for (dem::Column<Row>* column : {&node_mass, &node_velocity, &node_change}) column->resize(node_count);
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
  if (options.solve == MultiplierSolve::lumped)
    lump();
  else if (rotations)
    factor_whole(plain_mass);
  else
    factor_axes(plain_mass);
  const std::size_t cells = ties.cell_first.size() - 1;
  passes.resize((cells + cells_per_block - 1) / cells_per_block);
  cell_impulse.resize(8 * cells);
  node_first.assign(node_count + 1, 0);
  for (const std::int32_t node : ties.cell_nodes) ++node_first[static_cast<std::size_t>(node) + 1];
  for (std::size_t j = 0; j < node_count; ++j) node_first[j + 1] += node_first[j];
  node_entry.resize(ties.cell_nodes.size());
  std::vector<std::int32_t> next(node_first.begin(), node_first.end() - 1);
  for (std::size_t entry = 0; entry < ties.cell_nodes.size(); ++entry)
    node_entry[static_cast<std::size_t>(next[static_cast<std::size_t>(ties.cell_nodes[entry])]++)] =
        static_cast<std::int32_t>(entry);
}

void Multipliers::factor_axes(std::span<const double> plain_mass) {
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

void Multipliers::factor_whole(std::span<const double> plain_mass) {
  const auto rows = static_cast<std::int32_t>(ties.elements.size());
  const auto size = static_cast<Eigen::Index>(3 * ties.nodes.size());
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  Eigen::VectorXd weight(6 * rows);
  const auto add = [&](std::int32_t row, std::int32_t column, double value) {
    if (node_mass[static_cast<std::size_t>(column / 3)].value[column % 3] > 0)
      entries.emplace_back(row, column, value);
  };
  for (std::int32_t i = 0; i < rows; ++i)
    for (std::int32_t c = 0; c < 3; ++c) {
      weight[3 * i + c] = element_mass[static_cast<std::size_t>(i)].value[c];
      weight[3 * (rows + i) + c] = element_inertia[static_cast<std::size_t>(i)].value[c];
      for (RowMatrix::InnerIterator it(ties.k, i); it; ++it)
        add(3 * i + c, static_cast<std::int32_t>(3 * it.col()) + c, it.value());
      for (RowMatrix::InnerIterator it(ties.h, 3 * i + c); it; ++it)
        add(3 * (rows + i) + c, static_cast<std::int32_t>(it.col()), it.value());
    }
  RowMatrix both(6 * rows, size);
  both.setFromTriplets(entries.begin(), entries.end());
  WholeMatrix matrix = RowMatrix(both.transpose()) * RowMatrix(weight.asDiagonal() * both);
  for (Eigen::Index j = 0; j < size; ++j) matrix.coeffRef(j, j) += plain_mass[static_cast<std::size_t>(j / 3)];
  whole = std::make_unique<Eigen::SimplicialLLT<WholeMatrix>>(matrix);
  if (whole->info() != Eigen::Success)
    throw dem::RunError("the multipliers' matrix is not positive definite: a node of the overlap has no mass");
  spin_change.resize(ties.elements.size());
}

void Multipliers::lump() {
  // Row sums of C M^-1 C^T = M_d^-1 + k M_u^-1 k^T; k is not negative, so they bound its highest eigenvalue.
  dem::Column<Row> one(ties.elements.size()), share(ties.nodes.size()), sum(ties.elements.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) one[i].value[c] = element_mass[i].value[c] > 0 ? 1 : 0;
  multiply(ties.k.transpose(), one, share, 1);
  divide_by_mass(share, node_mass);
  multiply(ties.k, share, sum, 1);
  own.resize(ties.elements.size()), lumped.resize(ties.elements.size()), violation.resize(ties.elements.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double mass = element_mass[i].value[c];
      lumped[i].value[c] = mass > 0 ? 1 / (sum[i].value[c] + 1 / mass) : 0;  // lambda = lumped r
      own[i].value[c] = mass > 0 ? lumped[i].value[c] / mass : 0;
    }
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

void Multipliers::sum_at_nodes() {
  for (std::size_t j = 0; j < node_change.size(); ++j) {
    Row sum;
    for (std::int32_t p = node_first[j]; p < node_first[j + 1]; ++p) {
      const Row& part = cell_impulse[static_cast<std::size_t>(node_entry[static_cast<std::size_t>(p)])];
      for (std::size_t c = 0; c < 3; ++c) sum.value[c] += part.value[c];
    }
    node_change[j] = sum;
  }
}

void Multipliers::solve_nodes() {
  if (options.solve == MultiplierSolve::lumped) {
    divide_by_mass(node_change, node_mass);
    return;
  }
  for (std::size_t j = 0; j < node_change.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c)
      if (node_mass[j].value[c] == 0) node_change[j].value[c] = 0;
  if (groups.size() == 1) {
    groups.front().factor->solve(node_change, work);
    return;
  }
  const dem::Column<Row> right = node_change;
  for (const AxisGroup& group : groups) {
    dem::Column<Row> found = right;
    group.factor->solve(found, work);
    for (std::size_t j = 0; j < found.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c)
        if (group.axes[c]) node_change[j].value[c] = found[j].value[c];
  }
}

void Multipliers::solve_nodes_with_spins(DiscreteVelocities discrete) {
  const auto count = static_cast<Eigen::Index>(ties.elements.size()),
             nodes = static_cast<Eigen::Index>(ties.nodes.size());
  Eigen::VectorXd spin(3 * count), inertia(3 * count), u(3 * nodes), right(3 * nodes);
  for (Eigen::Index i = 0; i < 3 * count; ++i) {
    const auto row = static_cast<std::size_t>(i / 3), axis = static_cast<std::size_t>(i % 3);
    spin[i] = discrete.row(ties.elements[row])[3 + axis];
    inertia[i] = element_inertia[row].value[axis];
  }
  for (Eigen::Index j = 0; j < 3 * nodes; ++j) {
    u[j] = node_velocity[static_cast<std::size_t>(j / 3)].value[j % 3];
    right[j] = node_change[static_cast<std::size_t>(j / 3)].value[j % 3];
  }
  const Eigen::VectorXd spin_violation = spin - ties.h * u;
  right += ties.h.transpose() * inertia.cwiseProduct(spin_violation);
  for (Eigen::Index j = 0; j < 3 * nodes; ++j)
    if (node_mass[static_cast<std::size_t>(j / 3)].value[j % 3] == 0) right[j] = 0;
  const Eigen::VectorXd q = whole->solve(right);
  const Eigen::VectorXd change = ties.h * q - spin_violation;
  for (Eigen::Index j = 0; j < 3 * nodes; ++j) node_change[static_cast<std::size_t>(j / 3)].value[j % 3] = q[j];
  for (Eigen::Index i = 0; i < 3 * count; ++i)
    spin_change[static_cast<std::size_t>(i / 3)].value[i % 3] = inertia[i] > 0 ? change[i] : 0;
}

TieSums Multipliers::apply(DiscreteVelocities discrete, fe::State& nodes, double time_step) {
  for (std::size_t j = 0; j < node_velocity.size(); ++j) {
    const Vec3& u = nodes.velocity[static_cast<std::size_t>(ties.nodes[j])];
    node_velocity[j] = {{u.x(), u.y(), u.z(), 0}};
  }
  const double part = options.relaxation_time > time_step ? time_step / options.relaxation_time : 1;  // 1/p
  CellPass pass{};
  pass.cell_first = ties.cell_first.data(), pass.cell_nodes = ties.cell_nodes.data();
  pass.shape = ties.shape.data(), pass.element = ties.elements.data();
  pass.nodes = node_velocity.front().value;
  pass.velocity = discrete.first, pass.stride = discrete.stride;
  pass.mass = element_mass.front().value, pass.factor = (lumped.empty() ? element_mass : lumped).front().value;
  pass.cell_impulse = cell_impulse.front().value;
  if (!own.empty()) pass.own = own.front().value, pass.violation = violation.front().value;
  pass.part = part;
  const std::size_t cells = ties.cell_first.size() - 1;
  const auto for_each_block = [&](void (*loop)(CellPass&)) {
#pragma omp parallel for schedule(static) num_threads(options.threads) if (options.threads > 1)
    for (std::size_t block = 0; block < passes.size(); ++block) {
      passes[block] = pass;
      passes[block].begin = block * cells_per_block;
      passes[block].end = std::min(cells, (block + 1) * cells_per_block);
      loop(passes[block]);
    }
  };
  for_each_block(row_loops().violation);
  sum_at_nodes();
  if (whole)
    solve_nodes_with_spins(discrete);
  else
    solve_nodes();
  for (std::size_t j = 0; j < node_velocity.size(); ++j)
    for (std::size_t c = 0; c < 3; ++c) node_velocity[j].value[c] += node_change[j].value[c];
  for_each_block(row_loops().correct);

  TieSums sums;
  double change = 0;  // twice the kinetic energy's
  for (const CellPass& done : passes) {
    change += done.energy_change;
    sums.max_speed_squared = std::max(sums.max_speed_squared, done.max_speed_squared);
  }
  const auto add = [&](double mass, double& velocity, double by) {
    const double after = velocity + part * by;
    change += mass * (after * after - velocity * velocity);
    velocity = after;
  };
  for (std::size_t i = 0; i < spin_change.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      add(element_inertia[i].value[c], discrete.row(ties.elements[i])[3 + c], spin_change[i].value[c]);
  for (std::size_t j = 0; j < ties.nodes.size(); ++j) {
    Vec3& v = nodes.velocity[static_cast<std::size_t>(ties.nodes[j])];
    for (std::size_t c = 0; c < 3; ++c)
      add(node_mass[j].value[c], v[static_cast<Eigen::Index>(c)], node_change[j].value[c]);
  }
  sums.kinetic_change = 0.5 * change;
  return sums;
}

}  // namespace coupling
