#include "impact/run_record.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "libdem/core/error.h"
#include "libdem/probe/energy.h"
#include "libdem/run/checkpoint.h"

namespace impact {
namespace {

Vec3 along(const Vec3& vector, const std::array<bool, 3>& axes) {
  return {axes[0] ? vector.x() : 0, axes[1] ? vector.y() : 0, axes[2] ? vector.z() : 0};
}

double kinetic_of_elements(const dem::Particles& particles, const dem::Column<dem::Kinematics>& before) {
  double energy = 0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics &now = particles.kinematics[i], &then = before[i];
    energy += 0.5 * particles.element_mass(i) * (then.vx * now.vx + then.vy * now.vy + then.vz * now.vz) +
              0.5 * particles.element_inertia(i) * (then.wx * now.wx + then.wy * now.wy + then.wz * now.wz);
  }
  return energy;
}

/// The numbers of a sample in a row: time, force, impactor's place and velocity, broken links, energies,
/// probes.
constexpr std::size_t energy_columns = 13, fixed_columns = 11 + energy_columns;

std::array<double, energy_columns> row_of(const ImpactEnergy& e) {
  return {e.initial,         e.elements,        e.impactor,  e.nodes,   e.elastic,
          e.finite_elastic,  e.contact,         e.softening, e.sliding, e.damping,
          e.contact_sliding, e.contact_damping, e.ties};
}

ImpactEnergy energy_from(std::span<const double> e) {
  return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8], e[9], e[10], e[11], e[12]};
}

}  // namespace

Vec3 momentum_of(const ImpactModel& model, const Impactor* impactor, const ImpactorState& state) {
  const dem::Particles& particles = model.assembly.particles;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < particles.count; ++i)
    sum += particles.element_mass(i) * particles.kinematics[i].velocity();
  if (model.finite) sum += fe::momentum(model.finite->nodes);
  if (impactor != nullptr) sum += impactor->body.mass * state.motion.velocity - state.motion.support_impulse;
  return sum;
}

void book_supports(RunRecord& record, const ImpactModel& model) {
  Vec3 force = Vec3::Zero();  // on what is held: the supports give the opposite
  for (const Held& held : model.held_elements) {
    const double* row = model.assembly.particles.force[static_cast<std::size_t>(held.number)].value;
    force += along({row[0], row[1], row[2]}, held.axes);
  }
  for (const Held& held : model.held_nodes)
    force += along(model.finite->nodes.force[static_cast<std::size_t>(held.number)], held.axes);
  record.support_impulse -= model.time_step * force;
}

void book_step(RunRecord& record, const StepTaken& taken) {
  record.energy.sliding += taken.elements.sliding;
  record.energy.damping += taken.elements.damped;
  record.energy.contact_sliding += taken.impactor.sliding;
  record.energy.contact_damping += taken.impactor.damped;
  record.energy.ties -= taken.ties_change;
}

void read_energies(RunRecord& record, const ImpactModel& model, const StepTaken& taken,
                   const dem::Column<dem::Kinematics>& before, const std::vector<Vec3>& nodes_before) {
  const dem::Assembly& assembly = model.assembly;
  ImpactEnergy& energy = record.energy;
  energy.elements = kinetic_of_elements(assembly.particles, before);
  energy.impactor = taken.impactor.kinetic;
  energy.contact = taken.impactor.stored;
  const dem::PairEnergy links = dem::pair_energy(assembly.law, assembly.particles, assembly.links);
  const dem::PairEnergy contacts = dem::pair_energy(assembly.law, assembly.particles, assembly.contacts);
  energy.elastic = links.elastic + contacts.elastic;
  energy.softening = links.softening;
  if (model.finite) {
    fe::State nodes = model.finite->nodes;  // the force of this very step, whatever the interval
    fe::ElementRows room;
    fe::internal_force(*model.finite->body, nodes, room);
    energy.finite_elastic = fe::elastic_energy(nodes);
    energy.nodes = 0;
    for (std::size_t i = 0; i < nodes_before.size(); ++i)
      energy.nodes += 0.5 * nodes.mass[i] * nodes_before[i].dot(nodes.velocity[i]);
    const coupling::ImpulseEnergy impulses = model.finite->sub_stepping.impulse_energy(
        *model.finite->body, model.finite->nodes, nodes_before, model.time_step);
    energy.nodes += impulses.kinetic, energy.finite_elastic += impulses.elastic;
  }
  record.worst_imbalance = std::max(record.worst_imbalance, std::abs(energy.imbalance()));
}

dem::NamedNumbers numbers_of(const RunRecord& record, std::size_t probes) {
  dem::NamedNumbers numbers;
  std::vector<double>& rows = numbers["history"];
  rows.reserve(record.history.size() * (fixed_columns + 3 * probes));
  const auto put = [](std::vector<double>& to, const Vec3& v) { to.insert(to.end(), {v.x(), v.y(), v.z()}); };
  for (const Sample& sample : record.history) {
    rows.push_back(sample.time);
    put(rows, sample.force), put(rows, sample.impactor_position), put(rows, sample.impactor_velocity);
    rows.push_back(static_cast<double>(sample.broken_links));
    const auto parts = row_of(sample.energy);
    rows.insert(rows.end(), parts.begin(), parts.end());
    for (const Vec3& displacement : sample.displacement) put(rows, displacement);
  }
  const auto energy = row_of(record.energy);
  numbers["energy"].assign(energy.begin(), energy.end());
  std::vector<double>& rest = numbers["record"];
  rest = {static_cast<double>(record.steps),
          record.worst_imbalance,
          record.worst_momentum,
          record.farthest_damage,
          record.loop_seconds,
          record.overlap_seconds,
          record.wall_seconds};
  rest.push_back(static_cast<double>(record.broken_links));
  for (const Vec3* v :
       {&record.first_momentum, &record.support_impulse, &record.impulse_at_sample, &record.damage_place})
    put(rest, *v);
  numbers["force"] = record.force.to_numbers();
  return numbers;
}

void set_from(RunRecord& record, const dem::NamedNumbers& numbers, std::size_t probes,
              const std::string& where) {
  const std::size_t width = fixed_columns + 3 * probes;
  const auto column = [&](const std::string& name, std::size_t length) -> const std::vector<double>& {
    const auto found = numbers.find(name);
    if (found == numbers.end() || (length > 0 && found->second.size() != length))
      throw dem::InputError(where, fmt::format("has no whole column \"{}\"", name),
                            "start anew without --resume");
    return found->second;
  };
  const std::vector<double>& rows = column("history", 0);
  if (rows.size() % width != 0)
    throw dem::InputError(where, "has a history of another set of probes", "start anew without --resume");
  const auto three = [](const std::vector<double>& from, std::size_t at) {
    return Vec3(from[at], from[at + 1], from[at + 2]);
  };
  record.history.clear();
  for (std::size_t at = 0; at < rows.size(); at += width) {
    Sample sample;
    sample.time = rows[at];
    sample.force = three(rows, at + 1);
    sample.impactor_position = three(rows, at + 4);
    sample.impactor_velocity = three(rows, at + 7);
    sample.broken_links = static_cast<std::size_t>(rows[at + 10]);
    sample.energy = energy_from(std::span(rows).subspan(at + 11, energy_columns));
    for (std::size_t p = 0; p < probes; ++p)
      sample.displacement.push_back(three(rows, at + fixed_columns + 3 * p));
    record.history.push_back(std::move(sample));
  }
  record.energy = energy_from(column("energy", energy_columns));
  const std::vector<double>& rest = column("record", 20);
  record.steps = static_cast<std::int64_t>(rest[0]);
  record.worst_imbalance = rest[1], record.worst_momentum = rest[2], record.farthest_damage = rest[3];
  record.loop_seconds = rest[4], record.overlap_seconds = rest[5], record.wall_seconds = rest[6];
  record.broken_links = static_cast<std::size_t>(rest[7]);
  record.first_momentum = three(rest, 8), record.support_impulse = three(rest, 11);
  record.impulse_at_sample = three(rest, 14), record.damage_place = three(rest, 17);
  record.force = ForceRecord::from_numbers(column("force", 0), where);
}

}  // namespace impact
