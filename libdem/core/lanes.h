// Lanes: several pairs computed at once. A law is written once against the few functions below, as a template
// over its number type; it runs on plain doubles (the reference in the tests) and on lanes of 2, 4 or 8 doubles
// (the step loop).
//
// The files that use lanes are compiled once per instruction set, so everything here is always inlined and
// lives in a namespace of that set: no function compiled for a wide machine can be linked into the code of a
// narrow one.
#pragma once
#include <cstdint>

#define SPALL_INLINE static inline __attribute__((always_inline))

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define SPALL_LANES 8
#define SPALL_ISA avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define SPALL_LANES 4
#define SPALL_ISA avx2
#else
#define SPALL_LANES 2
#define SPALL_ISA baseline
#endif

#define SPALL_JOIN_(a, b) a##b
#define SPALL_JOIN(a, b) SPALL_JOIN_(a, b)

namespace dem {
inline namespace SPALL_ISA {

inline constexpr int lane_count = SPALL_LANES;
using Lanes = double __attribute__((vector_size(8 * SPALL_LANES)));
using Mask = std::int64_t __attribute__((vector_size(8 * SPALL_LANES)));

/// Every lane the same.
template <class Real>
SPALL_INLINE Real broadcast(double value) {
  if constexpr (sizeof(Real) == sizeof(double)) {
    return value;
  } else {
    return value - Real{};
  }
}

SPALL_INLINE Lanes load(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
SPALL_INLINE void store(double* to, Lanes lanes) { __builtin_memcpy(to, &lanes, sizeof lanes); }

SPALL_INLINE double select(bool mask, double yes, double no) { return mask ? yes : no; }
SPALL_INLINE Lanes select(Mask mask, Lanes yes, Lanes no) { return mask ? yes : no; }

template <class Real>
SPALL_INLINE Real larger(Real a, Real b) {
  return select(a > b, a, b);
}
template <class Real>
SPALL_INLINE Real smaller(Real a, Real b) {
  return select(a < b, a, b);
}

SPALL_INLINE double root(double value) { return __builtin_sqrt(value); }
SPALL_INLINE Lanes root(Lanes value) {
  Lanes result{};
  for (int k = 0; k < lane_count; ++k) result[k] = __builtin_sqrt(value[k]);
  return result;
}

/// The value with its own rounding: a product handed through here is not fused into the sum that uses it.
template <class Real>
SPALL_INLINE Real rounded(Real value) {
#if defined(__GNUC__) && !defined(__clang__)
  return __builtin_assoc_barrier(value);
#else
  return value;  // clang fuses within one expression only
#endif
}

SPALL_INLINE bool any(bool mask) { return mask; }
SPALL_INLINE bool any(Mask mask) {
  std::int64_t bits = 0;
  for (int k = 0; k < lane_count; ++k) bits |= mask[k];
  return bits != 0;
}

/// Sum over the lanes, in the order of the links whatever the width.
SPALL_INLINE double sum(double value) { return value; }
SPALL_INLINE double sum(Lanes value) {
  double total = 0;
  for (int k = 0; k < lane_count; ++k) total += value[k];
  return total;
}

}  // namespace SPALL_ISA
}  // namespace dem
