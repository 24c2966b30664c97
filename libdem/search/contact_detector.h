// Finds pairs that were never linked and now touch: a cell grid and a Verlet list with a skin.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/search/cell_grid.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Keeps the list of pairs closer than Ra + Rb + skin that are not links. The list is valid as long as no
/// element has moved more than skin/2 since it was built; `update` sees to that with a bound on the motion and
/// looks only when the bound could be exceeded. A pair keeps its shear history as long as it stays in the list.
class ContactDetector {
 public:
  /// `links`: all pairs that were linked at the start, broken or not; they are never contacts.
  /// `skin` [m]: 0 chooses 0.3 of the mean radius.
  ContactDetector(const Particles& particles, const Links& links, double skin = 0);

  /// Brings `contacts` up to date for the positions now. `max_speed` [m/s] bounds every element's speed since
  /// the last call. Returns true if the list was rebuilt (the incidence of `contacts` must then be made anew).
  bool update(const Particles& particles, Links& contacts, double max_speed, double time_step);

  int rebuilds() const { return rebuild_count; }
  double skin_width() const { return skin; }
  /// The positions of the last build and the motion since, for checkpoints.
  struct Memory {
    std::vector<Vec3> built_at;
    double moved_at_most = 0;
  };
  Memory memory() const { return {built_at, moved_at_most}; }
  void restore(Memory memory) { built_at = std::move(memory.built_at), moved_at_most = memory.moved_at_most; }

 private:
  void rebuild(const Particles& particles, Links& contacts);
  bool is_linked(std::int32_t i, std::int32_t j) const;

  double skin = 0, largest_radius = 0;
  std::vector<std::int32_t> first_partner, partners;  ///< of every element i the linked j > i, sorted
  std::vector<Vec3> built_at;                         ///< positions when the list was built
  double moved_at_most = 0;                           ///< bound on any displacement since [m]
  int rebuild_count = 0;
};

}  // namespace dem
