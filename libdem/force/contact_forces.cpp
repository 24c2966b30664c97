#include "libdem/force/contact_forces.h"

#include <algorithm>

#include "libdem/core/instructions.h"

namespace dem {
namespace {

const ContactLoops& contact_loops() {
  static const ContactLoops chosen = choose_instructions(baseline_contact_loops
#ifdef SPALL_X86
                                                         ,
                                                         avx2_contact_loops, avx512_contact_loops
#endif
  );
  return chosen;
}

}  // namespace

double evaluate_contacts(const LinkLaw& law, const Particles& particles, Links& contacts, double time_step,
                         ContactRows& rows, int threads) {
  const std::size_t padded = contacts.padded(),
                    block_count = (padded + contacts_per_block - 1) / contacts_per_block;
  rows.rows.resize(padded);
  rows.moments.resize(contacts.remembers_moments ? padded : 0);
  rows.block_sliding.resize(block_count);
  const ContactLoop loop = contact_loops().loop[law.choice()];
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t block = 0; block < block_count; ++block) {
    ContactLoopArguments arguments{&law,
                                   time_step,
                                   particles.kinematics.data(),
                                   contacts.a.data(),
                                   contacts.b.data(),
                                   contacts.inverse_initial_distance.data(),
                                   contacts.max_strain.data(),
                                   contacts.shear_x.data(),
                                   contacts.shear_y.data(),
                                   contacts.shear_z.data(),
                                   {contacts.slip.data(), contacts.moment_x.data(), contacts.moment_y.data(),
                                    contacts.moment_z.data(), contacts.twist.data()},
                                   rows.rows.data(),
                                   rows.moments.data(),
                                   block * contacts_per_block,
                                   std::min(padded, (block + 1) * contacts_per_block),
                                   0};
    loop(arguments);
    rows.block_sliding[block] = arguments.sliding;
  }
  double sliding = 0;
  for (const double part : rows.block_sliding) sliding += part;
  return sliding;
}

}  // namespace dem
