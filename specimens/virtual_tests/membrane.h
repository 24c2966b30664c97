// A membrane around a specimen's sides, on which a fluid presses: following forces on the elements that it
// touches.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/state/element_load.h"
#include "libdem/state/particles.h"
#include "specimens/specimen.h"

namespace virtual_tests {

/// A tube about an element size wide, of triangles along the nominal surface around `axis`, open at both ends.
/// A node moves with a weighted mean of a few elements near it, the weights such that the mean lies straight
/// under the node, and hands its force to them by the same weights. A triangle's force is the pressure times
/// its area as it is now, a third to each node. The area vectors of a closed surface sum to zero, and so do
/// their moments: as long as the ends stay plane, pressure neither pushes the specimen aside nor turns it,
/// however it has deformed. (The moment only to first order: the elements are a radius below the surface.) No
/// element feels a moment of its own, which would spin one that has broken loose.
class Membrane {
 public:
  /// Nodes at the ends hang on elements of the end layers, `size` thick, which platens hold plane.
  Membrane(const specimens::Specimen& specimen, int axis);

  /// The loads of `pressure` [Pa], sorted by element; they hold until the next call.
  std::span<const dem::ElementLoad> push(const dem::Particles& particles, double pressure);

  /// The area that the tube encloses across the axis at a level in the middle, as it is now [m2].
  double enclosed_area(const dem::Particles& particles) const;

 private:
  static constexpr std::size_t carriers = 6;  ///< elements that a node hangs on
  struct Node {
    dem::Vec3 at_rest;  ///< [m]
    std::array<std::int32_t, carriers> element;
    std::array<double, carriers> weight;
    std::array<std::size_t, carriers> load;  ///< places of the elements among the loads
  };
  static dem::Vec3 place(const Node& node, const dem::Particles& particles);

  int axis;
  std::size_t around = 0, levels = 0;                 ///< nodes of a level, levels
  std::vector<Node> nodes;                            ///< level by level
  std::vector<std::array<std::size_t, 3>> triangles;  ///< each part of the surface twice, see push
  std::vector<dem::Vec3> now, force;                  ///< of the nodes, room for push
  std::vector<dem::ElementLoad> loads;
};

}  // namespace virtual_tests
