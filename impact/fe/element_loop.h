// The loop over elements as each instruction set compiles it. Use motion.h; this is its inside.
#pragma once
#include <cstddef>
#include <cstdint>

namespace fe {

/// Plain pointers, so that code compiled for a wide machine meets no template of a library.
struct ElementLoopArguments {
  const std::int32_t* elements;  ///< which ones
  const double* stiffness;       ///< 24 x 24 a class, on a cache line
  const std::int32_t* element_class;
  const std::int32_t* connectivity;  ///< 8 an element
  const double* displacement;        ///< 3 a node
  double* rows;                      ///< out: K_e u_e, 24 for each of `elements`, on a cache line
};

/// Places [begin, end) of `elements`.
using ElementLoop = void (*)(const ElementLoopArguments&, std::size_t begin, std::size_t end);

ElementLoop baseline_fe_element_loop();
#ifdef SPALL_X86
ElementLoop avx2_fe_element_loop();
ElementLoop avx512_fe_element_loop();
#endif

}  // namespace fe
