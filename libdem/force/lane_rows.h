// Between rows in memory, one per element, and lanes: transposes.
#pragma once
#include <cstdint>

#include "libdem/core/lanes.h"
#include "libdem/law/moment_transfer.h"
#include "libdem/law/pair_kinematics.h"
#include "libdem/state/particles.h"

namespace dem {
inline namespace SPALL_ISA {

using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

template <class Part>
SPALL_INLINE Part load_part(const double* from) {
  Part part;
  __builtin_memcpy(&part, from, sizeof part);
  return part;
}
template <class Part>
SPALL_INLINE void store_part(double* to, Part part) {
  __builtin_memcpy(to, &part, sizeof part);
}

/// Four rows become four columns.
SPALL_INLINE void transpose(const Four (&row)[4], Four (&column)[4]) {
  const Four even01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
  const Four odd01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
  const Four even23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
  const Four odd23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
  column[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
  column[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
  column[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
  column[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

/// Two such transposes side by side.
SPALL_INLINE void transpose(const Eight (&row)[4], Eight (&column)[4]) {
  const Eight even01 = __builtin_shufflevector(row[0], row[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd01 = __builtin_shufflevector(row[0], row[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight even23 = __builtin_shufflevector(row[2], row[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd23 = __builtin_shufflevector(row[2], row[3], 1, 9, 3, 11, 5, 13, 7, 15);
  column[0] = __builtin_shufflevector(even01, even23, 0, 1, 8, 9, 4, 5, 12, 13);
  column[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 4, 5, 12, 13);
  column[2] = __builtin_shufflevector(even01, even23, 2, 3, 10, 11, 6, 7, 14, 15);
  column[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// The elements `index[0]`, `index[1]`, ...: rows of twelve doubles, one per lane, become eleven columns.
SPALL_INLINE PairElement<Lanes> gather(const Kinematics* kinematics, const std::int32_t* index) {
#if SPALL_LANES == 8
  Eight column[3][4];
  for (int part = 0; part < 3; ++part) {
    Eight row[4];
    for (int k = 0; k < 4; ++k)
      row[k] = __builtin_shufflevector(load_part<Four>(&kinematics[index[k]].x + 4 * part),
                                       load_part<Four>(&kinematics[index[k + 4]].x + 4 * part), 0, 1, 2, 3, 4,
                                       5, 6, 7);
    transpose(row, column[part]);
  }
#elif SPALL_LANES == 4
  Four column[3][4];
  for (int part = 0; part < 3; ++part) {
    Four row[4];
    for (int k = 0; k < 4; ++k) row[k] = load_part<Four>(&kinematics[index[k]].x + 4 * part);
    transpose(row, column[part]);
  }
#else
  Lanes column[3][4];
  const double *first = &kinematics[index[0]].x, *second = &kinematics[index[1]].x;
  for (int part = 0; part < 3; ++part)
    for (int c = 0; c < 4; ++c) column[part][c] = Lanes{first[4 * part + c], second[4 * part + c]};
#endif
  return {column[0][0], column[0][1], column[0][2], column[0][3], column[1][0], column[1][1],
          column[1][2], column[1][3], column[2][0], column[2][1], column[2][2]};
}

/// The element a time step on: what the step that is under way makes of its position.
SPALL_INLINE PairElement<Lanes> moved(PairElement<Lanes> element, double time_step) {
  element.x += time_step * element.vx;
  element.y += time_step * element.vy;
  element.z += time_step * element.vz;
  return element;
}

template <class Columns>
SPALL_INLINE MomentHistory<Lanes> load_moments(const Columns& columns, std::ptrdiff_t at) {
  return {load(columns.x + at), load(columns.y + at), load(columns.z + at), load(columns.twist + at)};
}
template <class Columns>
SPALL_INLINE void store_moments(const Columns& columns, std::ptrdiff_t at,
                                const MomentHistory<Lanes>& moments) {
  store(columns.x + at, moments.x);
  store(columns.y + at, moments.y);
  store(columns.z + at, moments.z);
  store(columns.twist + at, moments.twist);
}

/// Eight columns become one row of eight per lane; `take(lane, offset, part)` gets each row whole or in parts.
template <class Take>
SPALL_INLINE void to_rows(const Lanes (&column)[8], Take&& take) {
#if SPALL_LANES == 8
  Eight low[4], high[4];
  transpose({column[0], column[1], column[2], column[3]}, low);
  transpose({column[4], column[5], column[6], column[7]}, high);
  for (int k = 0; k < 4; ++k) {
    take(k, 0, __builtin_shufflevector(low[k], high[k], 0, 1, 2, 3, 8, 9, 10, 11));
    take(k + 4, 0, __builtin_shufflevector(low[k], high[k], 4, 5, 6, 7, 12, 13, 14, 15));
  }
#elif SPALL_LANES == 4
  for (int part = 0; part < 8; part += 4) {
    Four row[4];
    transpose({column[part], column[part + 1], column[part + 2], column[part + 3]}, row);
    for (int k = 0; k < 4; ++k) take(k, part, row[k]);
  }
#else
  for (int c = 0; c < 8; c += 2)
    for (int k = 0; k < 2; ++k) take(k, c, Lanes{column[c][k], column[c + 1][k]});
#endif
}

}  // namespace SPALL_ISA
}  // namespace dem
