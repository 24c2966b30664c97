#include "impact/outcome/fragments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "libdem/core/error.h"

namespace impact {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

void check(const ElementColumns& elements, const LinkColumns& links) {
  const std::size_t count = elements.position.size();
  if (elements.velocity.size() != count || elements.radius.size() != count || elements.mass.size() != count)
    throw dem::InputError("fragments",
                          fmt::format("{} positions, {} velocities, {} radii, {} masses", count,
                                      elements.velocity.size(), elements.radius.size(), elements.mass.size()),
                          "every element needs one of each");
  if (links.a.size() != links.b.size() || links.a.size() != links.broken.size())
    throw dem::InputError(
        "fragments",
        fmt::format("links have {}, {} and {} rows", links.a.size(), links.b.size(), links.broken.size()),
        "every link needs two elements and whether it is broken");
  for (std::size_t i = 0; i < count; ++i)
    if (!(elements.mass[i] > 0 && elements.radius[i] > 0))
      throw dem::InputError(
          "fragments",
          fmt::format("element {} has mass {} kg and radius {} m", i, elements.mass[i], elements.radius[i]),
          "both must be positive");
  for (std::size_t k = 0; k < links.a.size(); ++k)
    if (links.a[k] < 0 || links.b[k] < 0 || at(links.a[k]) >= count || at(links.b[k]) >= count)
      throw dem::InputError(
          "fragments", fmt::format("link {} joins elements {} and {} of {}", k, links.a[k], links.b[k], count),
          "elements are counted from 0");
}

/// The root of i, which is the lowest element of its set; shortens the way for the next time.
std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

}  // namespace

Fragments find_fragments(const ElementColumns& elements, const LinkColumns& links) {
  check(elements, links);
  const std::size_t count = elements.position.size();
  std::vector<std::int32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t k = 0; k < links.a.size(); ++k) {
    if (links.broken[k] != 0) continue;
    const std::int32_t a = root_of(parent, links.a[k]), b = root_of(parent, links.b[k]);
    parent[at(std::max(a, b))] = std::min(a, b);
  }

  // Sums run by element, so they do not depend on the order of the links.
  std::vector<Fragment> found;
  std::vector<Eigen::AlignedBox3d> box;
  std::vector<std::int32_t> number(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t root = root_of(parent, static_cast<std::int32_t>(i));
    if (at(root) == i) {
      number[i] = static_cast<std::int32_t>(found.size());
      found.emplace_back().first = root;
      box.emplace_back();
    }
    const std::int32_t n = number[i] = number[at(root)];
    Fragment& fragment = found[at(n)];
    const double radius = elements.radius[i], mass = elements.mass[i];
    ++fragment.elements;
    fragment.mass += mass;
    fragment.solid_volume += 4.0 / 3 * std::numbers::pi * radius * radius * radius;
    fragment.centre += mass * elements.position[i];
    fragment.velocity += mass * elements.velocity[i];
    fragment.kinetic_energy += 0.5 * mass * elements.velocity[i].squaredNorm();
    box[at(n)].extend(elements.position[i] - Vec3::Constant(radius));
    box[at(n)].extend(elements.position[i] + Vec3::Constant(radius));
  }
  std::vector<std::int32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const double one = found[at(a)].mass, other = found[at(b)].mass;
    return one != other ? one > other : found[at(a)].first < found[at(b)].first;
  });

  Fragments result;
  result.fragments.reserve(found.size());
  std::vector<std::int32_t> place(found.size());
  for (const std::int32_t n : order) {
    place[at(n)] = static_cast<std::int32_t>(result.fragments.size());
    Fragment fragment = found[at(n)];
    fragment.centre /= fragment.mass;
    fragment.velocity /= fragment.mass;
    fragment.extent = box[at(n)].sizes();
    result.fragments.push_back(fragment);
  }
  result.of_element.resize(count);
  for (std::size_t i = 0; i < count; ++i) result.of_element[i] = place[at(number[i])];
  return result;
}

DetachedSum sum_detached(const Fragments& fragments) {
  DetachedSum sum;
  for (std::size_t k = 1; k < fragments.fragments.size(); ++k) {
    const Fragment& fragment = fragments.fragments[k];
    ++sum.fragments;
    sum.elements += fragment.elements;
    sum.single_elements += fragment.elements == 1;
    sum.mass += fragment.mass;
    sum.largest_mass = std::max(sum.largest_mass, fragment.mass);
    if (fragment.elements > 1) sum.highest_speed = std::max(sum.highest_speed, fragment.velocity.norm());
    sum.kinetic_energy += fragment.kinetic_energy;
    sum.momentum += fragment.momentum();
  }
  return sum;
}

}  // namespace impact
