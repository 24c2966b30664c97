// Dry friction between platens and the elements that they press: what lies between greased and glued ends.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/drive/platens.h"
#include "libdem/state/element_load.h"
#include "libdem/state/particles.h"

namespace dem {

/// An element of a platen's layer hangs on the platen by a spring across the axis; the spring's force stays
/// below the coefficient of friction times the element's own push on the platen (Coulomb). The platens do not
/// move across the axis, so what the springs do not store is dissipated.
class PlatenFriction {
 public:
  /// `stiffness_over_radius`: of an element's spring over its radius [N/m2]; that of a link's shear spring
  /// between equal elements that touch is Ks/Kn C pi/2.
  PlatenFriction(const Particles& particles, const Platens& platens, double coefficient,
                 double stiffness_over_radius);
  PlatenFriction() = default;

  bool acts() const { return !holds.empty(); }
  /// Takes notice of what each element pushes with; call it after a step.
  void feel(const Particles& particles);
  /// The forces on the layers' elements for the step to come, by element; updates the springs.
  const std::vector<ElementLoad>& grip(const Particles& particles);
  /// Work that the springs have done on the elements so far, negative [J].
  double work() const { return done; }

  /// What a checkpoint must keep.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);

 private:
  struct Hold {
    std::int32_t element;
    double sign;       ///< of the push on the platen, along the axis
    double stiffness;  ///< [N/m]
    Vec3 anchor;       ///< where the spring is at rest [m]
    Vec3 position;     ///< of the element, when last looked at [m]
    Vec3 force;        ///< on the element, then [N]
    double push;       ///< on the platen, after the last step [N]
  };
  int axis = 0;
  double coefficient = 0;
  double done = 0;
  std::vector<Hold> holds;  ///< by element
  std::vector<ElementLoad> loads;
};

}  // namespace dem
