// Lagrange multipliers that hold overlapped discrete elements to the finite elements (Eq. 8), at the level of
// velocities, after both have made their free step.
//
// With C = [1, -K], r = C v the violation and M the weighted masses, the multipliers solve C M^-1 C^T lambda =
// r, and v loses M^-1 C^T lambda. That system has as many unknowns as tied motions and fills up when factored.
// The change q of the nodes' velocities solves one that is much smaller and has the same solution:
//   (M_u + K^T M_d K) q = K^T M_d r,   lambda = M_d (r - K q),
// so that nodes change by q and discrete elements by -(r - K q). It is factored once.
#pragma once
#include <Eigen/SparseCholesky>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "impact/coupling/kinematic_map.h"
#include "impact/coupling/node_factor.h"
#include "impact/coupling/row_loops.h"
#include "impact/fe/state.h"
#include "libdem/core/aligned.h"

namespace coupling {

enum class MultiplierSolve {
  consistent,  ///< as above: M-orthogonal, keeps energy
  lumped       ///< row sums for the matrix, no system to solve; loses energy. Displacements only
};

struct TieOptions {
  MultiplierSolve solve = MultiplierSolve::consistent;
  /// p dt, the time over which a violation is taken out [s]; the paper's reduction parameter p is this over the
  /// time step. Up to one time step the tie is strict (p = 1); longer ones lose energy.
  double relaxation_time = 0;
  int threads = 1;
};

/// Six velocities a discrete element, x, y, z and spin about x, y, z [m/s, rad/s], at `first + stride *
/// element`; see discrete_side.h.
struct DiscreteVelocities {
  double* first = nullptr;
  std::size_t stride = 6;

  double* row(std::int32_t element) const { return first + stride * static_cast<std::size_t>(element); }
};

/// Mass and inertia of the tied discrete elements, in the order of the map; weighted [kg, kg m2]. A 0 marks a
/// motion that is prescribed: it is not tied.
struct DiscreteMasses {
  std::vector<std::array<double, 6>> row;  ///< (m, m, m, I, I, I)
};

/// What one correction did.
struct TieSums {
  double kinetic_change = 0;     ///< of both domains together [J], never above 0
  double max_speed_squared = 0;  ///< of the tied discrete elements afterwards [m2/s2]: contact search must know
};

/// The multipliers of one map. It keeps no history: it can be made anew at any step.
class Multipliers {
 public:
  /// `nodes` gives the nodes' masses and which of their motions are locked. Throws InputError if the options do
  /// not fit each other, RunError if the matrix cannot be factored.
  Multipliers(const KinematicMap& map, const DiscreteMasses& masses, const fe::State& nodes,
              const TieOptions& options = {});

  /// Takes the violation out of the velocities, or the part dt/relaxation_time of it. Momentum is kept to
  /// rounding.
  TieSums apply(DiscreteVelocities discrete, fe::State& nodes, double time_step);

  /// Entries of the factor: what a solve costs.
  std::size_t factor_entries() const;
  const KinematicMap& map() const { return ties; }

 private:
  void factor_axes(std::span<const double> plain_mass);
  void factor_whole(std::span<const double> plain_mass);
  void lump();
  void sum_at_nodes();
  void solve_nodes();
  void solve_nodes_with_spins(DiscreteVelocities discrete);

  KinematicMap ties;
  TieOptions options;
  // Rows of four: three axes and one unused, so that a row is one vector.
  dem::Column<Row> element_mass, element_inertia, node_mass;  ///< 0 where not tied or locked [kg, kg m2]
  dem::Column<Row> lumped, own;  ///< see CellPass::factor, own; empty unless lumped
  dem::Column<Row> violation;    ///< by element, when lumped
  dem::Column<Row> cell_impulse, spin_change;
  dem::Column<Row> node_velocity, node_change;  ///< u; q
  dem::Column<Row> work;
  std::vector<CellPass> passes;                      ///< blocks of cells, summed in their order
  std::vector<std::int32_t> node_first, node_entry;  ///< where in cell_impulse a node finds its share
  /// Axes with the same locked motions share a factor.
  struct AxisGroup {
    std::array<bool, 3> axes = {false, false, false};
    std::shared_ptr<const NodeFactor> factor;
  };
  std::vector<AxisGroup> groups;
  using WholeMatrix = Eigen::SparseMatrix<double>;
  std::unique_ptr<Eigen::SimplicialLLT<WholeMatrix>> whole;  ///< with rotations: all three axes in one
};

}  // namespace coupling
