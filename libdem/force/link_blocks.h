// The links laid out for the step: blocks of neighbouring elements, eight elements side by side, each with the
// links that it owns. The layout depends on the specimen alone, never on threads or instructions.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libdem/core/aligned.h"
#include "libdem/state/links.h"

namespace dem {

/// Elements that share a lane group; a multiple of every lane count.
inline constexpr std::size_t group_width = 8;

/// A block is a range of element numbers whose forces are summed, and whose motion is advanced, by one thread
/// while they are in its cache. A link inside a block has one slot, owned by one of its two elements. A link
/// that crosses from one block to another has a slot in both, and is computed in both: no block waits for or
/// writes into another. The law gives both slots the same bits (see pair_kinematics), so a history has one
/// value.
///
/// Slot s = 8 * row + lane belongs to the element `owner[8 * group + lane]`; the rows of a group are
/// [first_row[group], first_row[group + 1]). Slots left over link ghosts: they have no force.
struct LinkBlocks : PairHistories {  // of the owner, one per slot; shear and moment on the owner
  struct Block {
    std::int32_t first_element = 0, end_element = 0;
    std::int32_t first_group = 0, end_group = 0;
  };
  std::vector<Block> blocks;
  std::size_t largest_block = 0;  ///< elements
  Column<std::int32_t> owner;     ///< eight per group; ghosts where a block's last group is not full
  std::vector<std::int32_t> first_row;

  // One per slot, see Links.
  Column<std::int32_t> partner;  ///< the other element
  Column<double> inverse_initial_distance;
  bool remembers_moments = false;

  std::size_t slots() const { return partner.size(); }

  LinkBlocks(const Links& links, std::size_t elements);
  LinkBlocks() = default;

  /// Takes the histories of `links` into the slots.
  void take_histories(const Links& links);
  /// Brings the histories back into `links`.
  void give_histories(Links& links) const;
  /// Number of links that have a slot in two blocks.
  std::size_t crossing_links() const;
  /// Whether the two slots of every crossing link hold the same history, bit for bit. They always do.
  bool copies_agree() const;

 private:
  /// Of link k: its slot, or its two, times 2, plus 1 if the slot's owner is the link's b; -1 for no second.
  struct Places {
    std::int32_t first = -1, second = -1;
  };
  std::vector<Places> places;
};

}  // namespace dem
