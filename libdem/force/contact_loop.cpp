// The loop over contacts, compiled once per instruction set.
#include "libdem/force/contact_loop.h"

#include <utility>

#include "libdem/core/lanes.h"
#include "libdem/force/lane_rows.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/law/moment_transfer.h"
#include "libdem/law/pair_kinematics.h"

namespace dem {
inline namespace SPALL_ISA {
namespace {

template <LinkChoices choices>
void contact_loop(ContactLoopArguments& arguments) {
  const LinkLaw law = *arguments.law;
  Lanes sliding{};
  for (std::size_t k = arguments.begin; k < arguments.end; k += lane_count) {
    const PairElement<Lanes> a = moved(gather(arguments.kinematics, arguments.a + k), arguments.time_step);
    const PairElement<Lanes> b = moved(gather(arguments.kinematics, arguments.b + k), arguments.time_step);
    const PairKinematics<Lanes> pair = pair_kinematics(a, b, arguments.time_step);
    PairHistory<Lanes> history{load(arguments.max_strain + k), load(arguments.shear_x + k),
                               load(arguments.shear_y + k), load(arguments.shear_z + k), Lanes{}};
    if constexpr (choices.moment_transfer) history.slip = load(arguments.moments.slip + k);
    const auto slid = [&](Lanes work) { sliding += work; };
    const Lanes inverse_initial_distance = load(arguments.inverse_initial_distance + k);
    const Lanes area = interaction_area(a, b);
    const PairForce<Lanes> force = evaluate<choices>(law, pair, inverse_initial_distance, area,
                                                     a.radius + b.radius, arguments.time_step, history, slid);
    if constexpr (choices.moment_transfer) {
      store(arguments.moments.slip + k, history.slip);
      MomentHistory<Lanes> moments = load_moments(arguments.moments, static_cast<std::ptrdiff_t>(k));
      const PairMoment<Lanes> moment =
          transfer_moment(law.moment, law.normal_modulus, a, b, pair, inverse_initial_distance, area,
                          force.normal, arguments.time_step, moments, slid);
      store_moments(arguments.moments, static_cast<std::ptrdiff_t>(k), moments);
      to_rows({Lanes{}, Lanes{}, Lanes{}, moment.x, moment.y, moment.z, Lanes{}, Lanes{}},
              [&](int lane, int offset, auto part) {
                store_part(arguments.moment_rows[k + static_cast<std::size_t>(lane)].value + offset, part);
              });
    }
    store(arguments.max_strain + k, history.max_strain);
    store(arguments.shear_x + k, history.shear_x);
    store(arguments.shear_y + k, history.shear_y);
    store(arguments.shear_z + k, history.shear_z);
    const Lanes columns[8] = {force.fx, force.fy, force.fz,   force.mx,
                              force.my, force.mz, pair.arm_a, pair.arm_b};
    to_rows(columns, [&](int lane, int offset, auto part) {
      store_part(arguments.rows[k + static_cast<std::size_t>(lane)].value + offset, part);
    });
  }
  arguments.sliding = sum(sliding);
}

}  // namespace
}  // namespace SPALL_ISA

ContactLoops SPALL_JOIN(SPALL_ISA, _contact_loops)() {
  using namespace SPALL_ISA;
  return []<std::size_t... number>(std::index_sequence<number...>) {
    return ContactLoops{{contact_loop<choices_of(number)>...}};
  }
  (std::make_index_sequence<link_choices>());
}

}  // namespace dem
