// One block of a step as each instruction set compiles it. Use step.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

#include "libdem/force/contact_loop.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/motion/central_difference.h"
#include "libdem/state/element_load.h"
#include "libdem/state/particles.h"

namespace dem {

/// Plain pointers, so that code compiled for a wide machine meets no template of a library.
struct BlockLoopArguments {
  const LinkLaw* law;
  double time_step;
  LocalDamping damping;

  const Kinematics* before;  ///< of all elements and ghosts, at the step's begin
  Kinematics* after;         ///< of the block's elements, at its end
  double* rotation;          ///< three an element
  const Inertia* inertia;
  const std::uint8_t* prescribed;
  bool all_forces;
  SixRow* force;

  // The links, see LinkBlocks.
  std::int32_t first_element, end_element, first_group, end_group;
  const std::int32_t *owner, *first_row, *partner;
  const double* inverse_initial_distance;
  double *max_strain, *shear_x, *shear_y, *shear_z;
  MomentColumns moments;

  // The contacts, already evaluated; null when there are none, or no moments.
  const ContactRow* contact_rows;
  const SixRow* contact_moments;
  const std::int32_t *contact_first, *contact_entry;

  // Loads from outside on the block's elements, in their order: an element and six numbers each.
  const std::int32_t* loaded;
  const SixRow* loads;
  std::size_t load_count;

  SixRow* sums;  ///< room for the block's elements and one more

  double sliding;     ///< out: dissipated by sliding; half of it where a link crosses to another block [J]
  MotionSums motion;  ///< out
};

using BlockLoop = void (*)(BlockLoopArguments&);

/// By LinkLaw::choice.
struct BlockLoops {
  BlockLoop loop[link_choices];
};

BlockLoops baseline_block_loops();
#ifdef SPALL_X86
BlockLoops avx2_block_loops();
BlockLoops avx512_block_loops();
#endif

}  // namespace dem
