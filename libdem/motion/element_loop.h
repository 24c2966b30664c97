// The loop over elements as each instruction set compiles it. Use central_difference.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

#include "libdem/force/pair_loop.h"
#include "libdem/state/particles.h"

namespace dem {

struct ElementLoopArguments {
  Kinematics* kinematics;
  const SixRow *mass, *inverse_mass;
  SixRow* force;
  const PairRow* link_rows;
  const std::int32_t *link_first, *link_entry;
  const PairRow* contact_rows;  ///< null when there are no contacts
  const std::int32_t *contact_first, *contact_entry;
  double time_step;
  double damping;  ///< local damping, 0 to 1
  double inverse_reference_velocity, inverse_reference_spin;
  std::size_t begin, end;    ///< elements
  double damped;             ///< out: dissipated by damping [J]
  double kinetic;            ///< out: 1/2 m v(-).v(+) [J]
  double max_speed_squared;  ///< out [m2/s2]
};

using ElementLoop = void (*)(ElementLoopArguments&);

ElementLoop baseline_element_loop();
#ifdef SPALL_X86
ElementLoop avx2_element_loop();
ElementLoop avx512_element_loop();
#endif

}  // namespace dem
