// Strain as the paper measures it: averaged over elements far from the faces (Fig. 3).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/state/particles.h"

namespace dem {

/// Normal strains along the three axes, extension positive.
using AxialStrains = std::array<double, 3>;

/// Least-squares gradient of the displacement of a fixed set of elements along each axis.
class StrainGauge {
 public:
  /// `members`: element numbers, at least two that differ along each axis.
  StrainGauge(std::span<const Vec3> initial_positions, std::vector<std::int32_t> members);

  AxialStrains measure(const Particles& particles) const;
  /// The same for displacements given 6 by 6 (a static solution).
  AxialStrains measure(std::span<const double> six_displacements) const;
  std::size_t size() const { return members.size(); }

 private:
  template <class Displacement>
  AxialStrains slopes(Displacement&& displacement) const;

  std::vector<std::int32_t> members;
  std::vector<Vec3> offset;  ///< position minus the members' mean [m]
  Vec3 spread = Vec3::Zero();
};

}  // namespace dem
