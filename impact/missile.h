// The penetration formulas on the scene at hand: a rigid missile that strikes a wall squarely.
#pragma once
#include <optional>
#include <string>

#include "impact/outcome/penetration_formulas.h"
#include "impact/outcome/slab_damage.h"
#include "impact/scene.h"

namespace impact {

/// The wall that the impactor comes to: the structure seen along its approach, which picks the face that it
/// looks at most squarely.
Slab struck_slab(const Scene& scene);

/// What the formulas say of a scene, or why they say nothing.
struct FormulaCheck {
  /// In words, empty if the formulas could be computed: no impactor, not along the wall's normal, no wall, an
  /// impactor without a diameter, f_c not given.
  std::string misfit;
  MissileCase missile;            ///< its diameter is that of equal area
  double perimeter_diameter = 0;  ///< that of equal perimeter, for CEA-EDF [m]
  NdrcResult ndrc;
  std::optional<CeaEdfResult> cea_edf;  ///< flat noses only
};
FormulaCheck check_formulas(const Scene& scene);

}  // namespace impact
