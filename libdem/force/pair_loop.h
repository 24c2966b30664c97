// The loop over pairs as each instruction set compiles it. Use pair_forces.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

#include "libdem/law/cohesive_link.h"
#include "libdem/state/particles.h"

namespace dem {

/// What one pair does to its two elements: force on a, moment per arm, the two arms. Eight doubles, one cache
/// line.
struct alignas(64) PairRow {
  double value[8];
};

/// Plain pointers, so that code compiled for a wide machine meets no template of a library.
struct PairLoopArguments {
  const LinkLaw* law;
  double time_step;
  const Kinematics* kinematics;
  const std::int32_t *a, *b;
  const double *inverse_initial_distance, *area;
  double *max_strain, *shear_x, *shear_y, *shear_z;
  PairRow* rows;
  std::size_t begin, end;  ///< pairs [begin, end), multiples of the padding
  double sliding;          ///< out: dissipated by sliding [J]
};

using PairLoop = void (*)(PairLoopArguments&);

/// By elastic_unloading + 2 proportional_cohesion + 4 contact_at_radii.
struct PairLoops {
  PairLoop loop[8];
};

PairLoops baseline_pair_loops();
#ifdef SPALL_X86
PairLoops avx2_pair_loops();
PairLoops avx512_pair_loops();
#endif

}  // namespace dem
