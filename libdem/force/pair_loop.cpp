// The loop over pairs, compiled once per instruction set.
#include "libdem/force/pair_loop.h"

#include "libdem/core/lanes.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/law/pair_kinematics.h"

namespace dem {
inline namespace SPALL_ISA {
namespace {

using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

[[maybe_unused]] SPALL_INLINE Four load_four(const double* from) {
  Four four;
  __builtin_memcpy(&four, from, sizeof four);
  return four;
}

/// Rows of twelve doubles, one per lane, become ten columns.
SPALL_INLINE PairElement<Lanes> gather(const Kinematics* kinematics, const std::int32_t* index) {
#if SPALL_LANES == 8
  Lanes column[12];
  for (int part = 0; part < 3; ++part) {  // four columns at a time: 4x4 transposes of two halves side by side
    Lanes row[4];
    for (int k = 0; k < 4; ++k)
      row[k] =
          __builtin_shufflevector(load_four(&kinematics[index[k]].x + 4 * part),
                                  load_four(&kinematics[index[k + 4]].x + 4 * part), 0, 1, 2, 3, 4, 5, 6, 7);
    const Lanes even01 = __builtin_shufflevector(row[0], row[1], 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes odd01 = __builtin_shufflevector(row[0], row[1], 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes even23 = __builtin_shufflevector(row[2], row[3], 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes odd23 = __builtin_shufflevector(row[2], row[3], 1, 9, 3, 11, 5, 13, 7, 15);
    column[4 * part + 0] = __builtin_shufflevector(even01, even23, 0, 1, 8, 9, 4, 5, 12, 13);
    column[4 * part + 1] = __builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 4, 5, 12, 13);
    if (part == 2) break;  // columns 10 and 11 are unused
    column[4 * part + 2] = __builtin_shufflevector(even01, even23, 2, 3, 10, 11, 6, 7, 14, 15);
    column[4 * part + 3] = __builtin_shufflevector(odd01, odd23, 2, 3, 10, 11, 6, 7, 14, 15);
  }
#elif SPALL_LANES == 4
  Lanes column[12];
  for (int part = 0; part < 3; ++part) {
    Lanes row[4];
    for (int k = 0; k < 4; ++k) row[k] = load_four(&kinematics[index[k]].x + 4 * part);
    const Lanes even01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
    const Lanes odd01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
    const Lanes even23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
    const Lanes odd23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
    column[4 * part + 0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
    column[4 * part + 1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
    if (part == 2) break;
    column[4 * part + 2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
    column[4 * part + 3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
  }
#else
  Lanes column[10];
  const double *first = &kinematics[index[0]].x, *second = &kinematics[index[1]].x;
  for (int c = 0; c < 10; ++c) column[c] = Lanes{first[c], second[c]};
#endif
  return {column[0], column[1], column[2], column[3], column[4],
          column[5], column[6], column[7], column[8], column[9]};
}

/// Eight columns become one row per lane.
SPALL_INLINE void store_rows(PairRow* rows, const Lanes (&column)[8]) {
#if SPALL_LANES == 8
  Eight pair[8], quad[8];
  for (int k = 0; k < 4; ++k) {
    pair[2 * k] = __builtin_shufflevector(column[2 * k], column[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pair[2 * k + 1] = __builtin_shufflevector(column[2 * k], column[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int h = 0; h < 2; ++h)
    for (int k = 0; k < 2; ++k) {
      quad[4 * h + k] = __builtin_shufflevector(pair[4 * h + k], pair[4 * h + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      quad[4 * h + k + 2] =
          __builtin_shufflevector(pair[4 * h + k], pair[4 * h + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int k = 0; k < 4; ++k) {
    const Eight low = __builtin_shufflevector(quad[k], quad[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    const Eight high = __builtin_shufflevector(quad[k], quad[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    __builtin_memcpy(rows[k].value, &low, sizeof low);
    __builtin_memcpy(rows[k + 4].value, &high, sizeof high);
  }
#elif SPALL_LANES == 4
  for (int h = 0; h < 2; ++h) {
    const Lanes* c = column + 4 * h;
    const Lanes even01 = __builtin_shufflevector(c[0], c[1], 0, 4, 2, 6);
    const Lanes odd01 = __builtin_shufflevector(c[0], c[1], 1, 5, 3, 7);
    const Lanes even23 = __builtin_shufflevector(c[2], c[3], 0, 4, 2, 6);
    const Lanes odd23 = __builtin_shufflevector(c[2], c[3], 1, 5, 3, 7);
    store(rows[0].value + 4 * h, __builtin_shufflevector(even01, even23, 0, 1, 4, 5));
    store(rows[1].value + 4 * h, __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5));
    store(rows[2].value + 4 * h, __builtin_shufflevector(even01, even23, 2, 3, 6, 7));
    store(rows[3].value + 4 * h, __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7));
  }
#else
  for (int k = 0; k < lane_count; ++k)
    for (int c = 0; c < 8; ++c) rows[k].value[c] = column[c][k];
#endif
}

template <LinkChoices choices>
void pair_loop(PairLoopArguments& arguments) {
  const LinkLaw law = *arguments.law;
  double sliding = 0;
  for (std::size_t k = arguments.begin; k < arguments.end; k += lane_count) {
    const PairElement<Lanes> a = gather(arguments.kinematics, arguments.a + k);
    const PairElement<Lanes> b = gather(arguments.kinematics, arguments.b + k);
    const PairKinematics<Lanes> pair = pair_kinematics(a, b, arguments.time_step);
    PairHistory<Lanes> history{load(arguments.max_strain + k), load(arguments.shear_x + k),
                               load(arguments.shear_y + k), load(arguments.shear_z + k)};
    const PairForce<Lanes> force =
        evaluate<choices>(law, pair, load(arguments.inverse_initial_distance + k), load(arguments.area + k),
                          a.radius + b.radius, arguments.time_step, history, sliding);
    store(arguments.max_strain + k, history.max_strain);
    store(arguments.shear_x + k, history.shear_x);
    store(arguments.shear_y + k, history.shear_y);
    store(arguments.shear_z + k, history.shear_z);
    const Lanes columns[8] = {force.fx, force.fy, force.fz,   force.mx,
                              force.my, force.mz, pair.arm_a, pair.arm_b};
    store_rows(arguments.rows + k, columns);
  }
  arguments.sliding = sliding;
}

}  // namespace
}  // namespace SPALL_ISA

PairLoops SPALL_JOIN(SPALL_ISA, _pair_loops)() {
  using namespace SPALL_ISA;
  return {{pair_loop<LinkChoices{false, false, false}>, pair_loop<LinkChoices{true, false, false}>,
           pair_loop<LinkChoices{false, true, false}>, pair_loop<LinkChoices{true, true, false}>,
           pair_loop<LinkChoices{false, false, true}>, pair_loop<LinkChoices{true, false, true}>,
           pair_loop<LinkChoices{false, true, true}>, pair_loop<LinkChoices{true, true, true}>}};
}

}  // namespace dem
