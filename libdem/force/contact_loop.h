// The loop over contacts as each instruction set compiles it. Use contact_forces.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

#include "libdem/law/cohesive_link.h"
#include "libdem/state/particles.h"

namespace dem {

/// What one contact does to its two elements: force on a, moment per arm, the two arms. Eight doubles, one
/// cache line.
struct alignas(64) ContactRow {
  double value[8];
};

/// The columns that a law with moments needs; null where it has none.
struct MomentColumns {
  double *slip, *x, *y, *z, *twist;
};

/// Plain pointers, so that code compiled for a wide machine meets no template of a library.
struct ContactLoopArguments {
  const LinkLaw* law;
  double time_step;
  const Kinematics* kinematics;  ///< at the step's begin
  const std::int32_t *a, *b;
  const double* inverse_initial_distance;
  double *max_strain, *shear_x, *shear_y, *shear_z;
  MomentColumns moments;
  ContactRow* rows;
  SixRow* moment_rows;     ///< rolling and twisting moments on a; null where the law has none
  std::size_t begin, end;  ///< contacts [begin, end), multiples of the padding
  double sliding;          ///< out: dissipated by sliding [J]
};

using ContactLoop = void (*)(ContactLoopArguments&);

/// By LinkLaw::choice.
struct ContactLoops {
  ContactLoop loop[link_choices];
};

ContactLoops baseline_contact_loops();
#ifdef SPALL_X86
ContactLoops avx2_contact_loops();
ContactLoops avx512_contact_loops();
#endif

}  // namespace dem
