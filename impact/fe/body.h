// An elastic body: a mesh and a material turned into what a step needs.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "impact/fe/hexahedron.h"
#include "impact/fe/material.h"
#include "impact/fe/mesh.h"
#include "libdem/core/aligned.h"

namespace fe {

struct BodyOptions {
  Formulation formulation = Formulation::incompatible_modes;
  /// Energy weight at each element's Gauss points, above 0 (the bridging domain's a); empty: 1 everywhere.
  std::vector<GaussWeights> weights;
  /// The node that moves for each node (periodic boundaries); empty: each for itself.
  std::vector<std::int32_t> representative;
};

/// Some of a body's elements, and the order in which their forces are summed at each node that they touch:
/// along `entry`, the same order on any number of threads.
struct Portion {
  std::vector<std::int32_t> elements;  ///< ascending
  std::vector<std::int32_t> nodes;     ///< ascending
  std::vector<std::int32_t> first;     ///< nodes + 1 offsets into `entry`
  std::vector<std::int32_t> entry;     ///< place in `elements` * 8 + corner, ascending

  Portion() = default;
  Portion(std::span<const Hexahedron> connectivity, std::vector<std::int32_t> chosen);
};

/// Stiffness and mass. It does not change during a run. Elements of one shape and weight share one stiffness.
struct Body {
  Material material;
  std::vector<Hexahedron> connectivity;     ///< representative nodes, by element
  dem::Column<ElementMatrix> stiffness;     ///< by class [N/m]
  std::vector<ShapeValues> corner_mass;     ///< by class [kg]
  std::vector<std::int32_t> element_class;  ///< by element
  std::vector<double> node_mass;            ///< lumped, weighted [kg]; 0 for a node that another moves for
  Portion all;                              ///< every element

  /// Throws InputError if the mesh or the material is refused, or a weight is not above 0.
  Body(const Mesh& mesh, const Material& material, const BodyOptions& options = {});

  std::size_t nodes() const { return node_mass.size(); }
  std::size_t elements() const { return connectivity.size(); }
  const ElementMatrix& element_stiffness(std::size_t element) const {
    return stiffness[static_cast<std::size_t>(element_class[element])];
  }
  /// [kg]
  double total_mass() const;
};

}  // namespace fe
