// The two platens of a press: layers of elements at the ends that move along the loading axis at a given speed.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libdem/state/particles.h"

namespace dem {

/// What the platens do to the lateral motion of the elements that they press: nothing (greased or brushed
/// platens), hold it (glued ends), or rub (dry steel, see PlatenFriction).
enum class EndCondition { free, fixed, rough };
std::string_view name_of(EndCondition ends);
/// The names that an input may give.
const std::vector<std::string>& end_condition_names();
/// The one of that name; free for an unknown name.
EndCondition end_condition(std::string_view name);

/// Elements whose centre is within `thickness` of either end, and what they feel.
struct Platens {
  int axis = 0;
  std::vector<std::int32_t> low, high;  ///< element numbers
  double gauge_length = 0;              ///< distance of the two layers' mean positions at rest [m]

  /// Reaction of each layer along the axis: the force that the specimen exerts on it, positive when it pushes
  /// the platen outwards, i.e. in compression [N].
  double low_reaction(const Particles& particles) const;
  double high_reaction(const Particles& particles) const;
};

/// Finds the two layers in [0, length] along `axis`. Throws InputError if either is empty.
Platens find_platens(const Particles& particles, int axis, double length, double thickness);

/// Prescribes closing speed `speed` [m/s] (negative pulls), half on each layer, and gives all other elements
/// the uniform strain rate that goes with it, so that the test starts without a shock.
void drive(Particles& particles, const Platens& platens, EndCondition ends, double speed);

}  // namespace dem
