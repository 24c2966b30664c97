// One block of a step, compiled once per instruction set: the links' forces are summed in the block's own rows,
// which stay in the cache, then its elements move.
#include "libdem/run/block_loop.h"

#include <utility>

#include "libdem/core/lanes.h"
#include "libdem/force/lane_rows.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/law/moment_transfer.h"
#include "libdem/law/pair_kinematics.h"
#include "libdem/motion/element_motion.h"

namespace dem {
inline namespace SPALL_ISA {
namespace {

constexpr int group_lanes = 8;

/// Adds one row per lane to the block's sums; elements outside the block all go to the spare row at its end.
SPALL_INLINE void add_rows(SixRow* sums, const std::int32_t* element, std::int32_t first, std::uint32_t count,
                           const Lanes (&column)[8]) {
  std::uint32_t place[lane_count];
  for (int k = 0; k < lane_count; ++k) {
    const auto local = static_cast<std::uint32_t>(element[k] - first);
    place[k] = local < count ? local : count;
  }
  to_rows(column, [&](int lane, int offset, auto part) {
    double* to = sums[place[lane]].value + offset;
    store_part(to, load_part<decltype(part)>(to) + part);
  });
}

/// Rows of links that are on their way from memory while one is computed.
constexpr std::ptrdiff_t rows_ahead = 8;

/// Asks for the links of a later row. Asking past the end does no harm.
template <bool moments>
SPALL_INLINE void prefetch_rows(const BlockLoopArguments& arguments, std::ptrdiff_t slot) {
  __builtin_prefetch(arguments.partner + slot, 0, 3);
  __builtin_prefetch(arguments.inverse_initial_distance + slot, 0, 3);
  __builtin_prefetch(arguments.max_strain + slot, 0, 3);
  __builtin_prefetch(arguments.shear_x + slot, 1, 3);
  __builtin_prefetch(arguments.shear_y + slot, 1, 3);
  __builtin_prefetch(arguments.shear_z + slot, 1, 3);
  if constexpr (moments) {
    for (const double* column : {arguments.moments.x, arguments.moments.y, arguments.moments.z})
      __builtin_prefetch(column + slot, 1, 3);
    __builtin_prefetch(arguments.moments.twist + slot, 1, 3);
    __builtin_prefetch(arguments.moments.slip + slot, 0, 3);
  }
}

template <LinkChoices choices>
void add_links(BlockLoopArguments& arguments) {
  const LinkLaw law = *arguments.law;
  const Kinematics* kinematics = arguments.before;
  const double time_step = arguments.time_step;
  const std::int32_t first = arguments.first_element;
  const auto count = static_cast<std::uint32_t>(arguments.end_element - first);
  const Lanes zero{};
  Lanes sliding{};
  for (std::int32_t group = arguments.first_group; group < arguments.end_group; ++group)
    for (int half = 0; half < group_lanes; half += lane_count) {
      const std::int32_t* owner = arguments.owner + std::ptrdiff_t{group_lanes} * group + half;
      const PairElement<Lanes> a = moved(gather(kinematics, owner), time_step);
      Lanes fx{}, fy{}, fz{}, mx{}, my{}, mz{};
      for (std::int32_t row = arguments.first_row[group]; row < arguments.first_row[group + 1]; ++row) {
        const std::ptrdiff_t slot = std::ptrdiff_t{group_lanes} * row + half;
        const std::int32_t* partner = arguments.partner + slot;
        prefetch_rows<choices.moment_transfer>(arguments, slot + group_lanes * rows_ahead);
        const PairElement<Lanes> b = moved(gather(kinematics, partner), time_step);
        const PairKinematics<Lanes> pair = pair_kinematics(a, b, time_step);
        PairHistory<Lanes> history{load(arguments.max_strain + slot), load(arguments.shear_x + slot),
                                   load(arguments.shear_y + slot), load(arguments.shear_z + slot), Lanes{}};
        const auto slid = [&](Lanes work) {
          for (int k = 0; k < lane_count; ++k) {  // a crossing link slides in two blocks
            const bool crosses = static_cast<std::uint32_t>(partner[k] - first) >= count;
            work[k] = crosses ? 0.5 * work[k] : work[k];
          }
          sliding += work;
        };
        const Lanes inverse_initial_distance = load(arguments.inverse_initial_distance + slot);
        const Lanes area = interaction_area(a, b);
        if constexpr (choices.moment_transfer) history.slip = load(arguments.moments.slip + slot);
        const PairForce<Lanes> force = evaluate<choices>(law, pair, inverse_initial_distance, area,
                                                         a.radius + b.radius, time_step, history, slid);
        if (force.damaged) [[unlikely]]
          store(arguments.max_strain + slot, history.max_strain);
        store(arguments.shear_x + slot, history.shear_x);
        store(arguments.shear_y + slot, history.shear_y);
        store(arguments.shear_z + slot, history.shear_z);
        fx += force.fx, fy += force.fy, fz += force.fz;
        mx += pair.arm_a * force.mx, my += pair.arm_a * force.my, mz += pair.arm_a * force.mz;
        Lanes px = pair.arm_b * force.mx, py = pair.arm_b * force.my, pz = pair.arm_b * force.mz;
        if constexpr (choices.moment_transfer) {
          store(arguments.moments.slip + slot, history.slip);
          MomentHistory<Lanes> moments = load_moments(arguments.moments, slot);
          const PairMoment<Lanes> moment =
              transfer_moment(law.moment, law.normal_modulus, a, b, pair, inverse_initial_distance, area,
                              force.normal, time_step, moments, slid);
          store_moments(arguments.moments, slot, moments);
          mx += moment.x, my += moment.y, mz += moment.z;
          px -= moment.x, py -= moment.y, pz -= moment.z;
        }
        add_rows(arguments.sums, partner, first, count,
                 {-force.fx, -force.fy, -force.fz, px, py, pz, zero, zero});
      }
      add_rows(arguments.sums, owner, first, count, {fx, fy, fz, mx, my, mz, zero, zero});
    }
  arguments.sliding = sum(sliding);
}

/// Adds the contacts of one element, in their order.
SPALL_INLINE void add_contacts(const BlockLoopArguments& arguments, std::int32_t element, Eight& total) {
  for (std::int32_t e = arguments.contact_first[element]; e < arguments.contact_first[element + 1]; ++e) {
    const std::int32_t pair = arguments.contact_entry[e] >> 1, side = arguments.contact_entry[e] & 1;
    const double* row = arguments.contact_rows[pair].value;
    const double sign = side == 0 ? 1 : -1, arm = row[6 + side];
    const Eight factor = {sign, sign, sign, arm, arm, arm, 0, 0};
    total += load_part<Eight>(row) * factor;
    if (arguments.contact_moments != nullptr)
      total += sign * load_part<Eight>(arguments.contact_moments[pair].value);
  }
}

/// Asks for what the motion of an element a little later needs, and for the next block's element in the same
/// place: that block's links read its elements here and there, which no hardware foresees.
SPALL_INLINE void prefetch_elements(const BlockLoopArguments& arguments, std::int32_t element) {
  constexpr std::int32_t elements_ahead = 16;
  const std::int32_t soon = element + elements_ahead;
  const std::int32_t next_block = element + (arguments.end_element - arguments.first_element);
  __builtin_prefetch(&arguments.before[next_block].x, 0, 2);
  __builtin_prefetch(&arguments.before[next_block].wy, 0, 2);
  __builtin_prefetch(&arguments.after[soon].x, 1, 3);
  __builtin_prefetch(&arguments.after[soon].wy, 1, 3);
  __builtin_prefetch(arguments.rotation + 3 * soon, 1, 3);
  __builtin_prefetch(arguments.inertia + soon, 0, 3);
}

void move_elements(BlockLoopArguments& arguments) {
  ElementMotion motion = element_motion(arguments.damping, arguments.time_step);
  const Eight zero{};
  std::size_t load = 0;
  for (std::int32_t i = arguments.first_element; i < arguments.end_element; ++i) {
    prefetch_elements(arguments, i);
    double* row = arguments.sums[i - arguments.first_element].value;
    Eight force = load_part<Eight>(row);
    store_part(row, zero);  // ready for the next block
    if (arguments.contact_rows != nullptr) add_contacts(arguments, i, force);
    for (; load < arguments.load_count && arguments.loaded[load] == i; ++load)
      force += load_part<Eight>(arguments.loads[load].value);
    const unsigned prescribed = arguments.prescribed[i];
    if (prescribed != 0 || arguments.all_forces) store_part(arguments.force[i].value, force);
    advance_element(motion, arguments.before[i], arguments.after[i], arguments.rotation + 3 * i,
                    arguments.inertia[i], prescribed, force);
  }
  store_part(arguments.sums[arguments.end_element - arguments.first_element].value, zero);
  double damped = 0, kinetic = 0;
  for (int c = 0; c < 6; ++c) damped += motion.damped[c], kinetic += motion.kinetic[c];
  arguments.motion = {0.5 * arguments.time_step * damped, 0.5 * kinetic, motion.fastest};
}

template <LinkChoices choices>
void block_loop(BlockLoopArguments& arguments) {
  add_links<choices>(arguments);
  move_elements(arguments);
}

}  // namespace
}  // namespace SPALL_ISA

BlockLoops SPALL_JOIN(SPALL_ISA, _block_loops)() {
  using namespace SPALL_ISA;
  return []<std::size_t... number>(std::index_sequence<number...>) {
    return BlockLoops{{block_loop<choices_of(number)>...}};
  }
  (std::make_index_sequence<link_choices>());
}

}  // namespace dem
