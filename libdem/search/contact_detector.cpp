#include "libdem/search/contact_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dem {
namespace {

constexpr std::size_t elements_per_part = 4096;  // that one thread looks at in one go
constexpr std::size_t queries_per_part = 256;

std::size_t parts_of(std::size_t count, std::size_t each) { return (count + each - 1) / each; }

}  // namespace

ContactDetector::ContactDetector(const Particles& particles, const Links& links, double wanted_skin) {
  double mean = 0;
  for (const double r : particles.radius) mean += r, largest_radius = std::max(largest_radius, r);
  mean /= static_cast<double>(std::max<std::size_t>(1, particles.count));
  skin = wanted_skin > 0 ? wanted_skin : 0.5 * mean;

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

void ContactDetector::restore(Memory memory) {
  built_at = std::move(memory.built_at), moved_at_most = memory.moved_at_most;
  cells = {};
}

bool ContactDetector::update(const Particles& particles, Links& contacts, double max_speed, double time_step,
                             int threads) {
  const bool first = built_at.size() != particles.count;
  moved_at_most += max_speed * time_step;
  if (!first && moved_at_most <= 0.5 * skin) return false;

  // What is left of skin/2 must do for the coming step and should do for some more: a look costs a pass over
  // all elements, but an element that is listed anew early is listed anew more often.
  if (first) built_at.assign(particles.count, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  const Look seen = look(particles, std::min(0.3 * skin, 0.5 * skin - max_speed * time_step), threads);
  const double coming = std::max(max_speed, seen.fastest) * time_step;
  moved_at_most = seen.farthest_of_rest + coming;
  if (seen.far.empty()) return first;

  ++rebuild_count;
  list_anew(particles, seen.far);
  // Where a step outruns the skin, the list must reach as far as two elements can come together in it.
  const double margin = std::max(skin, std::min(2 * coming, 2 * largest_radius));
  return replace(particles, contacts, pairs_of(particles, seen.far, margin, threads)) || first;
}

ContactDetector::Look ContactDetector::look(const Particles& particles, double allowed, int threads) const {
  const std::size_t parts = parts_of(particles.count, elements_per_part);
  const double allowed_square = allowed < 0 ? -1 : allowed * allowed;
  std::vector<Look> looks(parts);
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    Look& mine = looks[part];
    double rest = 0, fastest = 0;
    const std::size_t end = std::min(particles.count, (part + 1) * elements_per_part);
    for (std::size_t i = part * elements_per_part; i < end; ++i) {
      const Kinematics& k = particles.kinematics[i];
      const double square = (k.position() - built_at[i]).squaredNorm();
      fastest = std::max(fastest, k.velocity().squaredNorm());
      if (square <= allowed_square)
        rest = std::max(rest, square);
      else
        mine.far.push_back(static_cast<std::int32_t>(i));
    }
    mine.farthest_of_rest = std::sqrt(rest), mine.fastest = std::sqrt(fastest);
  }
  Look all;
  for (const Look& one : looks) {
    all.far.insert(all.far.end(), one.far.begin(), one.far.end());
    all.farthest_of_rest = std::max(all.farthest_of_rest, one.farthest_of_rest);
    all.fastest = std::max(all.fastest, one.fastest);
  }
  return all;
}

/// Takes the places of these elements now for their listed ones.
void ContactDetector::list_anew(const Particles& particles, const std::vector<std::int32_t>& far) {
  const bool ready = cells.points() == particles.count;
  is_far.assign(particles.count, 0);
  for (const std::int32_t number : far) {
    const auto i = static_cast<std::size_t>(number);
    const Vec3 place = particles.kinematics[i].position();
    if (ready) cells.move(i, built_at[i], place);
    built_at[i] = place;
    is_far[i] = 1;
  }
  if (!ready || cells.is_outgrown()) cells.build(built_at, 2 * largest_radius + skin);
}

/// The pairs that have an end in `far`, are no links and are nearer than Ra + Rb + margin [m]; sorted, lower
/// number first.
std::vector<ContactDetector::Pair> ContactDetector::pairs_of(const Particles& particles,
                                                             const std::vector<std::int32_t>& far,
                                                             double margin, int threads) const {
  const std::size_t parts = parts_of(far.size(), queries_per_part);
  std::vector<std::vector<Pair>> found(parts);
#pragma omp parallel for schedule(dynamic) num_threads(threads) if (threads > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t end = std::min(far.size(), (part + 1) * queries_per_part);
    for (std::size_t q = part * queries_per_part; q < end; ++q) {
      const std::int32_t i = far[q];
      const auto at = static_cast<std::size_t>(i);
      const Vec3 place = built_at[at];
      const auto meet = [&](std::int32_t j, double square) {
        const auto other = static_cast<std::size_t>(j);
        const double near = particles.radius[at] + particles.radius[other] + margin;
        if (!(square <= near * near) || j == i) return;
        if (j < i && is_far[other] != 0) return;  // of two far ends the lower one asks
        if (!is_linked(i, j)) found[part].emplace_back(std::min(i, j), std::max(i, j));
      };
      const double reach = particles.radius[at] + largest_radius + margin;
      cells.for_each_near(built_at, place, reach, meet);
    }
  }
  std::vector<Pair> all;
  for (const auto& one : found) all.insert(all.end(), one.begin(), one.end());
  std::sort(all.begin(), all.end());
  return all;
}

/// Contacts without a far end stay; of the others those that were found again keep their history, and the rest
/// goes. Returns false where that changes nothing.
bool ContactDetector::replace(const Particles& particles, Links& contacts,
                              const std::vector<Pair>& found) const {
  struct Listed {
    Pair pair;
    std::ptrdiff_t old;  ///< its place in `contacts`, or -1
  };
  std::vector<Listed> wanted;
  std::size_t next = 0;
  bool same = true;
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const Pair pair(contacts.a[k], contacts.b[k]);
    const bool stays =
        is_far[static_cast<std::size_t>(pair.first)] == 0 && is_far[static_cast<std::size_t>(pair.second)] == 0;
    for (; next < found.size() && found[next] < pair; ++next) wanted.push_back({found[next], -1}), same = false;
    const bool again = next < found.size() && found[next] == pair;
    if (again) ++next;
    if (stays || again)
      wanted.push_back({pair, static_cast<std::ptrdiff_t>(k)});
    else
      same = false;
  }
  for (; next < found.size(); ++next) wanted.push_back({found[next], -1}), same = false;
  if (same) return false;

  Links fresh;
  if (contacts.remembers_moments) fresh.remember_moments();
  for (const auto& [pair, old] : wanted) {
    const double ra = particles.radius[static_cast<std::size_t>(pair.first)],
                 rb = particles.radius[static_cast<std::size_t>(pair.second)];
    fresh.push(pair.first, pair.second, ra + rb, std::numbers::pi * std::min(ra, rb) * std::min(ra, rb),
               born_broken);
    if (old >= 0)
      for (const HistoryColumn& history : history_columns(contacts.remembers_moments))
        (fresh.*history.values).back() = (contacts.*history.values)[static_cast<std::size_t>(old)];
  }
  fresh.pad(static_cast<std::int32_t>(particles.count));
  contacts = std::move(fresh);
  return true;
}

}  // namespace dem
