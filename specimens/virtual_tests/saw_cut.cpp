#include "specimens/virtual_tests/saw_cut.h"

#include <fmt/format.h>

#include <cmath>

namespace virtual_tests {
namespace {

using dem::Vec3;
using specimens::Link;
using specimens::Specimen;

/// Depth of a point below the face that is sawn into.
double depth_of(const Specimen& specimen, const SawCut& notch, const Vec3& x) {
  return notch.from_face == 0 ? x[notch.into] : specimen.size[notch.into] - x[notch.into];
}

/// Whether the line between the two centres runs through the notch's middle plane.
bool crosses(const Specimen& specimen, const SawCut& notch, const Vec3& a, const Vec3& b) {
  const double from = a[notch.along] - notch.position, to = b[notch.along] - notch.position;
  if (from * to > 0 || from == to) return false;
  const Vec3 x = a + (b - a) * (from / (from - to));
  return depth_of(specimen, notch, x) < notch.depth;
}

}  // namespace

Specimen cut(const Specimen& whole, const SawCut& notch) {
  std::vector<unsigned char> gone(whole.elements(), 0);
  const auto aside = [&](std::int32_t i) {
    return std::abs(whole.centres[static_cast<std::size_t>(i)][notch.along] - notch.position);
  };
  for (std::size_t i = 0; i < whole.elements(); ++i)
    if (aside(static_cast<std::int32_t>(i)) < 0.5 * notch.width &&
        depth_of(whole, notch, whole.centres[i]) < notch.depth)
      gone[i] = 1;
  std::vector<Link> kept;
  for (const Link& link : whole.links) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    if (!crosses(whole, notch, whole.centres[a], whole.centres[b])) {
      kept.push_back(link);
    } else if (gone[a] == 0 && gone[b] == 0 &&
               (whole.centres[a] - whole.centres[b]).norm() < 1.001 * (whole.radii[a] + whole.radii[b])) {
      gone[aside(link.a) <= aside(link.b) ? a : b] = 1;
    }
  }

  Specimen rest = whole;
  rest.centres.clear(), rest.radii.clear(), rest.links.clear();
  std::vector<std::int32_t> number(whole.elements(), -1);
  for (std::size_t i = 0; i < whole.elements(); ++i) {
    if (gone[i] != 0) continue;
    number[i] = static_cast<std::int32_t>(rest.centres.size());
    rest.centres.push_back(whole.centres[i]);
    rest.radii.push_back(whole.radii[i]);
  }
  for (const Link& link : kept) {
    const std::int32_t a = number[static_cast<std::size_t>(link.a)],
                       b = number[static_cast<std::size_t>(link.b)];
    if (a >= 0 && b >= 0) rest.links.push_back({a, b, link.initial_distance});
  }
  rest.origin = fmt::format("{}, with a notch {:.4g} mm deep", whole.origin, 1e3 * notch.depth);
  return rest;
}

}  // namespace virtual_tests
