// Finds pairs that were never linked and now touch: a cell grid and a Verlet list with a skin.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "libdem/search/cell_lists.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Keeps the list of pairs that are closer than Ra + Rb + skin and are not links, each element taken at its
/// listed place. The list is valid as long as no element is farther than skin/2 from its listed place. `update`
/// sees to that with a bound on the motion, and looks only when the bound could be exceeded. Then the elements
/// that have come far are listed anew where they are, and only their pairs are looked for: the work goes with
/// what moves, not with the size of the whole. A pair keeps its shear history as long as it stays in the list.
class ContactDetector {
 public:
  /// `links`: all pairs that were linked at the start, broken or not; they are never contacts.
  /// `skin` [m]: 0 chooses half the mean radius.
  ContactDetector(const Particles& particles, const Links& links, double skin = 0);

  /// Brings `contacts` up to date for a step that is to move every element by at most max_speed * time_step
  /// from where it is now; `max_speed` [m/s]. To call it with the speeds of a step that has been made does no
  /// harm. Returns true if the list was changed (the incidence of `contacts` must then be made anew). The list
  /// does not depend on `threads`.
  bool update(const Particles& particles, Links& contacts, double max_speed, double time_step, int threads = 1);

  /// How often elements were listed anew.
  int rebuilds() const { return rebuild_count; }
  double skin_width() const { return skin; }
  /// The listed places and the motion since, for checkpoints.
  struct Memory {
    std::vector<Vec3> built_at;
    double moved_at_most = 0;
  };
  Memory memory() const { return {built_at, moved_at_most}; }
  void restore(Memory memory);

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  struct Look {
    std::vector<std::int32_t> far;  ///< elements that must be listed anew, ascending
    double farthest_of_rest = 0;    ///< distance of any other from its listed place [m]
    double fastest = 0;             ///< of all elements [m/s]
  };
  Look look(const Particles& particles, double allowed, int threads) const;
  void list_anew(const Particles& particles, const std::vector<std::int32_t>& far);
  std::vector<Pair> pairs_of(const Particles& particles, const std::vector<std::int32_t>& far, double margin,
                             int threads) const;
  bool replace(const Particles& particles, Links& contacts, const std::vector<Pair>& found) const;
  bool is_linked(std::int32_t i, std::int32_t j) const;

  double skin = 0, largest_radius = 0;
  std::vector<std::int32_t> first_partner, partners;  ///< of every element i the linked j > i, sorted
  std::vector<Vec3> built_at;                         ///< each element's listed place
  double moved_at_most = 0;  ///< bound on the distance of any element from its place after the coming step [m]
  int rebuild_count = 0;

  CellLists cells;  ///< of the listed places; made when it is first needed
  std::vector<std::uint8_t> is_far;
};

}  // namespace dem
