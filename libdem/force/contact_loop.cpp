// The loop over contacts, compiled once per instruction set.
#include "libdem/force/contact_loop.h"

#include "libdem/core/lanes.h"
#include "libdem/force/lane_rows.h"
#include "libdem/law/cohesive_link.h"
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
                               load(arguments.shear_y + k), load(arguments.shear_z + k)};
    const PairForce<Lanes> force = evaluate<choices>(
        law, pair, load(arguments.inverse_initial_distance + k), interaction_area(a, b), a.radius + b.radius,
        arguments.time_step, history, [&](Lanes work) { sliding += work; });
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
  return {{contact_loop<LinkChoices{false, false, false}>, contact_loop<LinkChoices{true, false, false}>,
           contact_loop<LinkChoices{false, true, false}>, contact_loop<LinkChoices{true, true, false}>,
           contact_loop<LinkChoices{false, false, true}>, contact_loop<LinkChoices{true, false, true}>,
           contact_loop<LinkChoices{false, true, true}>, contact_loop<LinkChoices{true, true, true}>}};
}

}  // namespace dem
