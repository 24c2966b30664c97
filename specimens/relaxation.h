// Pushes overlapping elements apart, all at once, again and again (after Jodrey and Tory, 1985).
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "specimens/specimen.h"

namespace specimens {

struct RelaxationOptions {
  Shape shape = Shape::box;
  Vec3 size = Vec3::Zero();  ///< [m]
  double wall_share = 1;     ///< a centre keeps this share of its radius from the faces
  double tolerance = 0.02;   ///< stop when no overlap exceeds this share of Ra + Rb
  std::size_t most_sweeps = 3000;
  int threads = 1;
  /// Called after each sweep with the largest overlap (share of Ra + Rb); may throw.
  std::function<void(std::size_t sweep, double largest_overlap)> after_sweep;
};

struct RelaxationResult {
  std::size_t sweeps = 0;
  double largest_overlap = 0;  ///< share of Ra + Rb
};

/// Moves `centres` [m] until the spheres of `radii` [m] hardly overlap. Each element gathers the push of its
/// neighbours in a fixed order from the last sweep's positions: the same bits for any number of threads.
RelaxationResult relax(std::vector<Vec3>& centres, std::span<const double> radii,
                       const RelaxationOptions& options);

}  // namespace specimens
