#include "libdem/state/links.h"

#include <algorithm>
#include <numbers>

namespace dem {

void Links::push(std::int32_t first, std::int32_t second, double initial_distance, double interaction_area,
                 double initial_max_strain) {
  a.push_back(first);
  b.push_back(second);
  inverse_initial_distance.push_back(1 / initial_distance);
  area.push_back(interaction_area);
  for (const HistoryColumn& history : history_columns(remembers_moments)) (this->*history.values).push_back(0);
  max_strain.back() = initial_max_strain;
  ++count;
}

void Links::reserve(std::size_t pairs) {
  const std::size_t padded = (pairs + link_padding - 1) / link_padding * link_padding;
  for (Column<std::int32_t>* column : {&a, &b}) column->reserve(padded);
  for (Column<double>* column : {&inverse_initial_distance, &area}) column->reserve(padded);
  for (const HistoryColumn& history : history_columns(remembers_moments))
    (this->*history.values).reserve(padded);
}

void Links::pad(std::int32_t ghost) {
  const std::size_t real = count;
  while (a.size() % link_padding != 0) push(ghost, ghost + 1, 1, 0);
  count = real;
}

void Links::remember_moments() {
  if (remembers_moments) return;
  remembers_moments = true;
  for (const HistoryColumn& history : history_columns(true).subspan(history_columns(false).size()))
    (this->*history.values).assign(padded(), 0);
}

void Links::clear() { *this = Links{}; }

Links make_links(std::span<const LinkGeometry> pairs, std::span<const double> radii) {
  Links links;
  links.reserve(pairs.size());
  for (const LinkGeometry& pair : pairs) {
    const double r = std::min(radii[static_cast<std::size_t>(pair.a)], radii[static_cast<std::size_t>(pair.b)]);
    links.push(pair.a, pair.b, pair.initial_distance, std::numbers::pi * r * r);
  }
  links.pad(static_cast<std::int32_t>(radii.size()));
  return links;
}

Incidence::Incidence(const Links& links, std::size_t elements)
    : first(elements + 1, 0), entry(2 * links.count) {
  for (std::size_t k = 0; k < links.count; ++k) {
    ++first[static_cast<std::size_t>(links.a[k]) + 1];
    ++first[static_cast<std::size_t>(links.b[k]) + 1];
  }
  for (std::size_t i = 0; i < elements; ++i) first[i + 1] += first[i];
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  for (std::size_t k = 0; k < links.count; ++k) {
    const auto pair = static_cast<std::int32_t>(2 * k);
    entry[static_cast<std::size_t>(next[static_cast<std::size_t>(links.a[k])]++)] = pair;
    entry[static_cast<std::size_t>(next[static_cast<std::size_t>(links.b[k])]++)] = pair + 1;
  }
}

}  // namespace dem
