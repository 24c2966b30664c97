#include "libdem/run/step.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/instructions.h"
#include "libdem/core/memory.h"
#include "libdem/core/sha256.h"

namespace dem {
namespace {

BlockLoops chosen_block_loops() {
  return choose_instructions(baseline_block_loops
#ifdef SPALL_X86
                             ,
                             avx2_block_loops, avx512_block_loops
#endif
  );
}

/// Loads as the blocks take them: the elements, and a row of six numbers each.
struct LoadRows {
  std::vector<std::int32_t> element;
  Column<SixRow> row;

  explicit LoadRows(std::span<const ElementLoad> loads) {
    for (const ElementLoad& load : loads) {
      element.push_back(load.element);
      row.push_back({{load.force.x(), load.force.y(), load.force.z(), load.moment.x(), load.moment.y(),
                      load.moment.z(), 0, 0}});
    }
  }
};

// What a step keeps beside specimen and assembly, and what the first steps add.
constexpr double bytes_a_link = 100, bytes_an_element = 300;

Assembly& with_its_memory(Assembly& assembly) {
  require_memory(
      bytes_a_link * static_cast<double>(assembly.links.count) +
          bytes_an_element * static_cast<double>(assembly.particles.count),
      "elements",
      fmt::format("a run of {} elements and {} links", assembly.particles.count, assembly.links.count));
  if (assembly.law.transfers_moments)
    for (Links* links : {&assembly.links, &assembly.contacts}) links->remember_moments();
  return assembly;
}

}  // namespace

StepRoom::StepRoom(Assembly& assembly)
    : link_blocks(with_its_memory(assembly).links, assembly.particles.count),
      detector(assembly.particles, assembly.links),
      loops(chosen_block_loops()),
      smallest_radius(assembly.particles.count == 0
                          ? 0
                          : *std::min_element(assembly.particles.radius.begin(),
                                              assembly.particles.radius.begin() +
                                                  static_cast<std::ptrdiff_t>(assembly.particles.count))),
      next(assembly.particles.kinematics) {}

void settle(Assembly& assembly, const StepRoom& room) { room.link_blocks.give_histories(assembly.links); }

StepSums advance(Assembly& assembly, StepRoom& room, const StepOptions& options,
                 std::span<const ElementLoad> loads) {
  Particles& particles = assembly.particles;
  LinkBlocks& links = room.link_blocks;
  StepSums sums;

  if (room.detector.update(particles, assembly.contacts, room.max_speed, options.time_step, options.threads))
    room.contact_incidence = Incidence(assembly.contacts, particles.count);
  const bool contacts = assembly.contacts.count > 0;
  if (contacts)
    sums.sliding += evaluate_contacts(assembly.law, particles, assembly.contacts, options.time_step,
                                      room.contact_rows, options.threads);

  const LoadRows load_rows(loads);
  const BlockLoop loop = room.loops.loop[assembly.law.choice()];
  room.block_sums.resize(links.blocks.size());
  room.sums.resize(std::max(room.sums.size(), static_cast<std::size_t>(options.threads)));
#pragma omp parallel for schedule(static) num_threads(options.threads) if (options.threads > 1)
  for (std::size_t b = 0; b < links.blocks.size(); ++b) {
    const LinkBlocks::Block& block = links.blocks[b];
    Column<SixRow>& room_for_sums = room.sums[static_cast<std::size_t>(omp_get_thread_num())];
    room_for_sums.resize(links.largest_block + 1);
    const auto first_load =
        std::lower_bound(load_rows.element.begin(), load_rows.element.end(), block.first_element);
    const auto end_load = std::lower_bound(first_load, load_rows.element.end(), block.end_element);
    const std::ptrdiff_t load = first_load - load_rows.element.begin();
    BlockLoopArguments arguments{};
    arguments.law = &assembly.law;
    arguments.time_step = options.time_step;
    arguments.damping = options.damping;
    arguments.before = particles.kinematics.data();
    arguments.after = room.next.data();
    arguments.rotation = particles.rotation.front().data();
    arguments.inertia = particles.inertia.data();
    arguments.prescribed = particles.prescribed.data();
    arguments.all_forces = options.all_forces;
    arguments.force = particles.force.data();
    arguments.first_element = block.first_element;
    arguments.end_element = block.end_element;
    arguments.first_group = block.first_group;
    arguments.end_group = block.end_group;
    arguments.owner = links.owner.data();
    arguments.first_row = links.first_row.data();
    arguments.partner = links.partner.data();
    arguments.inverse_initial_distance = links.inverse_initial_distance.data();
    arguments.max_strain = links.max_strain.data();
    arguments.shear_x = links.shear_x.data();
    arguments.shear_y = links.shear_y.data();
    arguments.shear_z = links.shear_z.data();
    arguments.moments = {links.slip.data(), links.moment_x.data(), links.moment_y.data(), links.moment_z.data(),
                         links.twist.data()};
    if (contacts) {
      arguments.contact_rows = room.contact_rows.rows.data();
      arguments.contact_moments =
          room.contact_rows.moments.empty() ? nullptr : room.contact_rows.moments.data();
      arguments.contact_first = room.contact_incidence.first.data();
      arguments.contact_entry = room.contact_incidence.entry.data();
    }
    arguments.loaded = load_rows.element.data() + load;
    arguments.loads = load_rows.row.data() + load;
    arguments.load_count = static_cast<std::size_t>(end_load - first_load);
    arguments.sums = room_for_sums.data();
    loop(arguments);
    room.block_sums[b] = {arguments.sliding, arguments.motion};
  }
  particles.kinematics.swap(room.next);

  double fastest = 0;
  for (const auto& [sliding, motion] : room.block_sums) {
    sums.sliding += sliding;
    sums.damped += motion.damped;
    sums.kinetic += motion.kinetic;
    fastest = std::max(fastest, motion.max_speed_squared);
  }
  room.max_speed = std::sqrt(fastest);
  return sums;
}

std::string state_sha256(const Assembly& assembly) {
  Sha256 hash;
  const Particles& p = assembly.particles;
  hash.add(p.kinematics.data(), p.count * sizeof(Kinematics)).add(p.rotation.data(), p.count * sizeof(Vec3));
  for (const Links* links : {&assembly.links, &assembly.contacts}) {
    for (const Column<std::int32_t>* column : {&links->a, &links->b})
      hash.add(column->data(), links->count * sizeof(std::int32_t));
    for (const HistoryColumn& history : history_columns(links->remembers_moments))
      hash.add((links->*history.values).data(), links->count * sizeof(double));
  }
  return hash.hex();
}

}  // namespace dem
