// What an impact has broken off: elements that unbroken links still hold together.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/vector.h"

namespace impact {

using dem::Vec3;

/// Elements, column by column; all of one length.
struct ElementColumns {
  std::span<const Vec3> position;  ///< [m]
  std::span<const Vec3> velocity;  ///< [m/s]
  std::span<const double> radius;  ///< [m]
  std::span<const double> mass;    ///< [kg]
};

/// Links, column by column; all of one length.
struct LinkColumns {
  std::span<const std::int32_t> a, b;  ///< element numbers
  std::span<const std::uint8_t> broken;
};

/// Elements that unbroken links connect.
struct Fragment {
  std::size_t elements = 0;
  std::int32_t first = 0;        ///< the lowest of its elements' numbers
  double mass = 0;               ///< [kg]
  double solid_volume = 0;       ///< of its spheres [m3]
  Vec3 centre = Vec3::Zero();    ///< of mass [m]
  Vec3 velocity = Vec3::Zero();  ///< of the centre of mass [m/s]
  Vec3 extent = Vec3::Zero();    ///< of the box along the axes that holds its spheres [m]
  double kinetic_energy = 0;     ///< of its elements' translation, spinning as a whole included [J]

  Vec3 momentum() const { return mass * velocity; }  ///< [kg m/s]
};

struct Fragments {
  std::vector<Fragment> fragments;       ///< the heaviest first, equally heavy ones by `first`
  std::vector<std::int32_t> of_element;  ///< element -> index into `fragments`

  /// The heaviest fragment is the main body: what is left of the structure. All others are detached.
  static constexpr std::int32_t main_body = 0;
  bool detached(std::size_t element) const { return of_element[element] != main_body; }
};

/// Throws InputError if columns of one table differ in length, a link names no element, or a mass or radius is
/// not positive.
Fragments find_fragments(const ElementColumns& elements, const LinkColumns& links);

/// All that is not the main body, together.
struct DetachedSum {
  std::size_t fragments = 0, elements = 0;
  std::size_t single_elements = 0;  ///< fragments of one element: below the model's resolution, dust
  double mass = 0;                  ///< [kg]
  double largest_mass = 0;          ///< of one fragment [kg]
  double highest_speed = 0;         ///< of a fragment of at least two elements [m/s]
  double kinetic_energy = 0;        ///< [J]
  Vec3 momentum = Vec3::Zero();     ///< [kg m/s]
};
DetachedSum sum_detached(const Fragments& fragments);

}  // namespace impact
