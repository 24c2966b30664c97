#include "libdem/search/contact_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dem {

ContactDetector::ContactDetector(const Particles& particles, const Links& links, double wanted_skin) {
  double mean = 0;
  for (const double r : particles.radius) mean += r, largest_radius = std::max(largest_radius, r);
  mean /= static_cast<double>(std::max<std::size_t>(1, particles.count));
  skin = wanted_skin > 0 ? wanted_skin : 0.3 * mean;
  moved_at_most = std::numeric_limits<double>::infinity();

  first_partner.assign(particles.count + 1, 0);
  for (std::size_t k = 0; k < links.count; ++k)
    ++first_partner[static_cast<std::size_t>(std::min(links.a[k], links.b[k])) + 1];
  for (std::size_t i = 0; i < particles.count; ++i) first_partner[i + 1] += first_partner[i];
  partners.resize(links.count);
  std::vector<std::int32_t> next(first_partner.begin(), first_partner.end() - 1);
  for (std::size_t k = 0; k < links.count; ++k)
    partners[static_cast<std::size_t>(next[static_cast<std::size_t>(std::min(links.a[k], links.b[k]))]++)] =
        std::max(links.a[k], links.b[k]);
  for (std::size_t i = 0; i < particles.count; ++i)
    std::sort(partners.begin() + first_partner[i], partners.begin() + first_partner[i + 1]);
}

bool ContactDetector::is_linked(std::int32_t i, std::int32_t j) const {
  const auto low = static_cast<std::size_t>(std::min(i, j));
  return std::binary_search(partners.begin() + first_partner[low], partners.begin() + first_partner[low + 1],
                            std::max(i, j));
}

bool ContactDetector::update(const Particles& particles, Links& contacts, double max_speed, double time_step) {
  moved_at_most += max_speed * time_step;
  if (moved_at_most <= 0.5 * skin && built_at.size() == particles.count) return false;
  if (built_at.size() == particles.count) {  // the bound is exceeded: was it really so far?
    double square = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      square = std::max(square, (particles.kinematics[i].position() - built_at[i]).squaredNorm());
    moved_at_most = std::sqrt(square);
    // Looking costs a pass over the elements; a list with little left to go would be looked at every step.
    if (moved_at_most <= 0.35 * skin) return false;
  }
  rebuild(particles, contacts);
  return true;
}

void ContactDetector::rebuild(const Particles& particles, Links& contacts) {
  built_at.resize(particles.count);
  for (std::size_t i = 0; i < particles.count; ++i) built_at[i] = particles.kinematics[i].position();
  moved_at_most = 0;
  ++rebuild_count;

  const double reach = 2 * largest_radius + skin;
  const CellGrid grid(built_at, reach);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  grid.for_each_pair_within(reach, [&](std::int32_t i, std::int32_t j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double near = particles.radius[a] + particles.radius[b] + skin;
    if ((built_at[b] - built_at[a]).squaredNorm() <= near * near && !is_linked(i, j))
      pairs.emplace_back(std::min(i, j), std::max(i, j));
  });
  std::sort(pairs.begin(), pairs.end());

  Links fresh;
  std::size_t old = 0;
  for (const auto& [i, j] : pairs) {
    const double ra = particles.radius[static_cast<std::size_t>(i)],
                 rb = particles.radius[static_cast<std::size_t>(j)];
    fresh.push(i, j, ra + rb, std::numbers::pi * std::min(ra, rb) * std::min(ra, rb), born_broken);
    while (old < contacts.count && std::pair(contacts.a[old], contacts.b[old]) < std::pair(i, j)) ++old;
    if (old < contacts.count && contacts.a[old] == i && contacts.b[old] == j) {
      fresh.shear_x.back() = contacts.shear_x[old];
      fresh.shear_y.back() = contacts.shear_y[old];
      fresh.shear_z.back() = contacts.shear_z[old];
    }
  }
  fresh.pad(static_cast<std::int32_t>(particles.count));
  contacts = std::move(fresh);
}

}  // namespace dem
