#include "specimens/virtual_tests/setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "libdem/core/error.h"

namespace virtual_tests {

using specimens::Shape;
using specimens::Specimen;

dem::Assembly make_assembly(const Specimen& specimen, const dem::MaterialCard& card) {
  return {dem::Particles(specimen.centres, specimen.radii, card.density * specimen.volume()),
          dem::make_links(specimen.links, specimen.radii),
          {},
          dem::make_link_law(card)};
}

dem::LinkNetwork link_network(const Specimen& specimen, const dem::Assembly& assembly) {
  return {specimen.centres, specimen.radii, specimen.links, assembly.law};
}

int loading_axis(const Specimen& specimen, int wanted) {
  if (wanted < 0) return specimen.long_axis();
  if (specimen.shape == Shape::cylinder && wanted != 2)
    throw dem::InputError("axis", "a cylinder cannot be loaded across its axis here", "allowed: z");
  return wanted;
}

std::vector<std::int32_t> gauge_elements(const Specimen& specimen, int axis) {
  const double size = specimen.element_size(), length = specimen.size[axis];
  const double end_zone = std::min(4 * size, 0.3 * length), side_zone = 2 * size;
  std::vector<std::int32_t> members;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const dem::Vec3& x = specimen.centres[i];
    if (x[axis] < end_zone || x[axis] > length - end_zone) continue;
    dem::Vec3 inside = x;  // depth from the sides only
    inside[axis] = 0.5 * length;
    if (specimen.depth(inside) >= std::min(side_zone, 0.45 * length))
      members.push_back(static_cast<std::int32_t>(i));
  }
  if (members.size() < 8)
    throw dem::InputError(
        "specimen", fmt::format("has only {} elements in the zone where strain is measured", members.size()),
        "make it with more elements, or less slender");
  return members;
}

}  // namespace virtual_tests
