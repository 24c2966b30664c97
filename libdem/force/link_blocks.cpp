#include "libdem/force/link_blocks.h"

#include <algorithm>
#include <numeric>

namespace dem {
namespace {

/// A link as one of its elements sees it.
struct Owned {
  std::int32_t link, side;  ///< side 0: the owner is a
};

/// Blocks of 1,400 to 2,800 elements: their forces stay in a core's cache, and few links cross from one to
/// another (docs/performance.md has what other sizes gave). Where there are many, a multiple of four: shared
/// out evenly. A few smaller blocks would share out no better and cross more: 6,600 elements make four.
std::size_t number_of_blocks(std::size_t elements) {
  const std::size_t wanted = std::clamp<std::size_t>(elements / 32, 1400, 2800);
  if (elements < 4 * wanted) return 2 * elements < 3 * wanted ? 1 : 2;
  return (elements / wanted + 1) / 4 * 4;
}

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

/// Shares out the links inside blocks so that all elements of a block own nearly the same number: rows are as
/// long as the longest of eight.
std::vector<std::uint8_t> balanced_sides(const Links& links, const std::vector<std::int32_t>& block_of,
                                         std::vector<std::int32_t> owned) {
  std::vector<std::uint8_t> side(links.count, 0);
  const auto inside = [&](std::size_t k) { return block_of[index(links.a[k])] == block_of[index(links.b[k])]; };
  for (std::size_t k = 0; k < links.count; ++k)
    if (inside(k)) {
      std::int32_t &a = owned[index(links.a[k])], &b = owned[index(links.b[k])];
      side[k] = b < a;
      ++(side[k] == 0 ? a : b);
    }
  // Hands a link over where that evens out. A link between equals goes over now and then too, so that a surplus
  // wanders until it meets a shortage.
  for (std::size_t round = 0; round < 24; ++round)
    for (std::size_t k = 0; k < links.count; ++k)
      if (inside(k)) {
        std::int32_t& has = owned[index(side[k] == 0 ? links.a[k] : links.b[k])];
        std::int32_t& gets = owned[index(side[k] == 0 ? links.b[k] : links.a[k])];
        if (has > gets + 1 || (has == gets + 1 && (7 * k + round) % 3 == 0)) {
          --has, ++gets;
          side[k] ^= 1u;
        }
      }
  return side;
}

}  // namespace

LinkBlocks::LinkBlocks(const Links& links, std::size_t elements) {
  const std::size_t block_count = number_of_blocks(elements);
  std::vector<std::int32_t> block_of(elements);
  for (std::size_t b = 0; b < block_count; ++b) {
    const auto edge = [&](std::size_t n) {
      return n == block_count ? elements : n * elements / block_count / group_width * group_width;
    };
    Block block;
    block.first_element = static_cast<std::int32_t>(edge(b));
    block.end_element = static_cast<std::int32_t>(edge(b + 1));
    std::fill(block_of.begin() + block.first_element, block_of.begin() + block.end_element,
              static_cast<std::int32_t>(b));
    largest_block = std::max(largest_block, edge(b + 1) - edge(b));
    blocks.push_back(block);
  }

  // Who owns what. A crossing link is owned on both sides.
  const auto crosses = [&](std::size_t k) {
    return block_of[index(links.a[k])] != block_of[index(links.b[k])];
  };
  std::vector<std::int32_t> count(elements, 0);
  for (std::size_t k = 0; k < links.count; ++k)
    if (crosses(k)) ++count[index(links.a[k])], ++count[index(links.b[k])];
  const std::vector<std::uint8_t> side = balanced_sides(links, block_of, count);
  for (std::size_t k = 0; k < links.count; ++k)
    if (!crosses(k)) ++count[index(side[k] == 0 ? links.a[k] : links.b[k])];
  std::vector<std::int32_t> begin(elements + 1, 0);
  for (std::size_t i = 0; i < elements; ++i) begin[i + 1] = begin[i] + count[i];
  std::vector<Owned> owned(index(begin[elements]));
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < links.count; ++k)
    for (const std::int32_t s : {0, 1})
      if (crosses(k) || side[k] == s)
        owned[index(next[index(s == 0 ? links.a[k] : links.b[k])]++)] = {static_cast<std::int32_t>(k), s};

  // Eight elements that own equally many go side by side; otherwise the order of the elements is kept.
  const auto ghost = static_cast<std::int32_t>(elements);
  first_row.push_back(0);
  for (Block& block : blocks) {
    block.first_group = static_cast<std::int32_t>(first_row.size()) - 1;
    std::vector<std::int32_t> order(index(block.end_element - block.first_element));
    std::iota(order.begin(), order.end(), block.first_element);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t i, std::int32_t j) { return count[index(i)] > count[index(j)]; });
    for (std::size_t g = 0; g < order.size(); g += group_width) {
      for (std::size_t lane = 0; lane < group_width; ++lane)
        owner.push_back(g + lane < order.size() ? order[g + lane] : ghost);
      first_row.push_back(first_row.back() + count[index(order[g])]);
    }
    block.end_group = static_cast<std::int32_t>(first_row.size()) - 1;
  }

  const std::size_t slot_count = index(first_row.back()) * group_width;
  partner.assign(slot_count, ghost + 1);
  inverse_initial_distance.assign(slot_count, 0);
  remembers_moments = links.remembers_moments;
  for (const HistoryColumn& history : history_columns(remembers_moments))
    (this->*history.values).assign(slot_count, 0);
  places.resize(links.count);
  for (std::size_t group = 0; group + 1 < first_row.size(); ++group)
    for (std::size_t lane = 0; lane < group_width; ++lane) {
      const std::int32_t i = owner[group_width * group + lane];
      if (i == ghost) continue;
      for (std::int32_t n = 0; n < count[index(i)]; ++n) {
        const Owned& link = owned[index(begin[index(i)] + n)];
        const std::size_t k = index(link.link), slot = index(first_row[group] + n) * group_width + lane;
        partner[slot] = link.side == 0 ? links.b[k] : links.a[k];
        inverse_initial_distance[slot] = links.inverse_initial_distance[k];
        const auto place = static_cast<std::int32_t>(2 * slot) + link.side;
        (places[k].first < 0 ? places[k].first : places[k].second) = place;
      }
    }
  take_histories(links);
}

void LinkBlocks::take_histories(const Links& links) {
  for (const auto& [name, values, exchanged] : history_columns(remembers_moments)) {
    const Column<double>& from = links.*values;
    Column<double>& to = this->*values;
    for (std::size_t k = 0; k < links.count; ++k)
      for (const std::int32_t place : {places[k].first, places[k].second})
        if (place >= 0) to[index(place >> 1)] = (place & 1) == 0 ? from[k] : exchanged * from[k];
  }
}

void LinkBlocks::give_histories(Links& links) const {
  for (const auto& [name, values, exchanged] : history_columns(remembers_moments)) {
    const Column<double>& from = this->*values;
    Column<double>& to = links.*values;
    for (std::size_t k = 0; k < links.count; ++k) {
      const std::int32_t place = places[k].first;
      to[k] = (place & 1) == 0 ? from[index(place >> 1)] : exchanged * from[index(place >> 1)];
    }
  }
}

std::size_t LinkBlocks::crossing_links() const {
  return static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [](const Places& p) { return p.second >= 0; }));
}

bool LinkBlocks::copies_agree() const {
  return std::all_of(places.begin(), places.end(), [&](const Places& p) {
    if (p.second < 0) return true;
    const std::size_t one = index(p.first >> 1), two = index(p.second >> 1);
    const auto histories = history_columns(remembers_moments);
    return std::all_of(histories.begin(), histories.end(), [&](const HistoryColumn& history) {
      return (this->*history.values)[one] == history.exchanged * (this->*history.values)[two];
    });
  });
}

}  // namespace dem
