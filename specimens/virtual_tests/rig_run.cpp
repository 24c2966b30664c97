#include "specimens/virtual_tests/rig_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/motion/critical_step.h"
#include "libdem/run/watch.h"
#include "specimens/virtual_tests/checkpoint_keeper.h"
#include "specimens/virtual_tests/expected_end.h"
#include "specimens/virtual_tests/rig_record.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/static_start.h"

namespace virtual_tests {
namespace {

/// Sets all velocities to `factor` times what they are.
void scale_velocities(dem::Particles& particles, double factor) {
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int c = 0; c < 6; ++c) particles.kinematics[i].rate(c) *= factor;
}

double fastest(const dem::Particles& particles) {
  double square = 0;
  for (std::size_t i = 0; i < particles.count; ++i)
    square = std::max(square, particles.kinematics[i].velocity().squaredNorm());
  return std::sqrt(square);
}

double mass_of(const dem::Particles& particles, std::size_t i, int dof) {
  return dof < 3 ? particles.element_mass(i) : particles.element_inertia(i);
}

double kinetic_energy(const dem::Particles& particles) {
  double energy = 0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics& k = particles.kinematics[i];
    energy += 0.5 * particles.element_mass(i) * k.velocity().squaredNorm() +
              0.5 * particles.element_inertia(i) * k.spin().squaredNorm();
  }
  return energy;
}

/// A prescribed degree of freedom.
struct Held {
  std::size_t element;
  int dof;
};

std::vector<Held> held_in(const dem::Particles& particles) {
  std::vector<Held> held;
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int c = 0; c < 6; ++c)
      if (particles.is_prescribed(i, c)) held.push_back({i, c});
  return held;
}

/// Power of whatever holds and drives, against the forces of the step before or after the motion [W].
double power_of_holding(const dem::Particles& particles, const std::vector<Held>& held) {
  double power = 0;
  for (const auto& [i, c] : held) power -= particles.force[i].value[c] * particles.kinematics[i].rate(c);
  return power;
}

double kinetic_energy(const dem::Particles& particles, const std::vector<Held>& held) {
  double energy = 0;
  for (const auto& [i, c] : held) {
    const double v = particles.kinematics[i].rate(c);
    energy += 0.5 * mass_of(particles, i, c) * v * v;
  }
  return energy;
}

double power_of_loads(const dem::Particles& particles, std::span<const dem::ElementLoad> loads) {
  double power = 0;
  for (const dem::ElementLoad& load : loads) {
    const dem::Kinematics& k = particles.kinematics[static_cast<std::size_t>(load.element)];
    power += load.force.dot(k.velocity()) + load.moment.dot(k.spin());
  }
  return power;
}

/// Everything that follows from the inputs. Leaves the assembly moving as it starts, its forces at zero.
RigPlan make_plan(const Rig& rig, const dem::MaterialCard& card, const QuasiStaticOptions& options,
                  dem::Assembly& assembly) {
  dem::Particles& particles = assembly.particles;
  const specimens::Specimen& specimen = rig.specimen();
  const dem::LinkNetwork network = link_network(specimen, assembly);
  RigPlan plan;
  plan.facts = rig.facts();
  if (options.expected_strength > 0) plan.facts.expected_strength = options.expected_strength;
  plan.expected_force = plan.facts.expected_strength / plan.facts.stress_per_force;
  plan.critical_time_step = dem::critical_time_step(network, particles);

  rig.hold(particles);
  start_as_elastic(particles, network);
  const double stiffness = rig.read(particles).force;  // per unit of the control
  if (!(stiffness > 0) || !std::isfinite(stiffness))
    throw dem::RunError(fmt::format("the {} test finds no stiffness in the specimen", plan.facts.name));
  plan.elastic_control = plan.expected_force / stiffness;
  const double wave_speed = std::sqrt(card.young_modulus / card.density);
  const double rate = options.rate > 0 ? options.rate : plan.facts.rate;
  plan.velocity =
      options.velocity > 0 ? options.velocity : plan.elastic_control * rate * wave_speed / plan.facts.length;
  plan.rise_time = plan.elastic_control / plan.velocity;
  plan.stop_at = options.stop_at > 0 ? options.stop_at : plan.facts.stop_at;
  plan.furthest = options.max_control > 0 ? options.max_control : plan.facts.furthest * plan.elastic_control;

  scale_velocities(particles, plan.facts.starts_at_rest ? 0 : plan.velocity);
  std::fill(particles.force.begin(), particles.force.end(), dem::SixRow{});
  const double time_step = options.time_step_fraction * plan.critical_time_step;
  // Damping acts fully on velocities above a thousandth of what is driven: below that they are rounding, not
  // motion.
  const double slow = 1e-3 * plan.velocity * (plan.facts.control.unit == "m" ? 1 : plan.facts.length);
  plan.step = {time_step, {options.damping, slow, slow / (0.5 * specimen.element_size())}, options.threads};
  plan.half_window = std::clamp(std::lround(plan.rise_time / 120 / time_step) / 2, 1L, 500L);
  return plan;
}

dem::Progress where_it_stands(const RigRecord& record, const RigPlan& plan, bool over) {
  const CurvePoint& last = record.shape.back();
  const double guess = std::min(plan.facts.likely_end * plan.elastic_control, plan.furthest);
  const double end = expected_end(record.shape, record.peak_index, guess, plan.stop_at, plan.furthest);
  const auto done = static_cast<double>(record.steps);
  const double total = end / (plan.velocity * plan.step.time_step) + static_cast<double>(plan.half_window);
  const bool metres = plan.facts.control.unit == "m";
  return {
      plan.facts.name, done, over ? done : std::max(total, done + 1), "steps",
      fmt::format("{:.2f} MPa at {:.4g} {}", last.stress / 1e6, 1e3 * last.strain, metres ? "mm" : "permil")};
}

}  // namespace

TestOutcome run_rig(Rig& rig, const dem::MaterialCard& card, const QuasiStaticOptions& options,
                    const std::string& sha256_of_options, const dem::ProgressCallback& progress,
                    const CheckpointPolicy& checkpoint) {
  options.validate();
  RigRecord record(rig.facts(), checkpoint.pictures);
  dem::Assembly assembly = make_assembly(rig.specimen(), card);
  dem::Particles& particles = assembly.particles;
  const RigPlan plan = make_plan(rig, card, options, assembly);
  record.ledger.initial = kinetic_energy(particles);

  dem::StepRoom room(assembly);
  room.max_speed = fastest(particles);
  dem::Belonging belonging;
  if (!checkpoint.file.empty())
    belonging = {
        {"specimen", rig.specimen().sha256()}, {"card", sha256_of(card)}, {"options", sha256_of_options}};
  CheckpointKeeper keeper(checkpoint, std::move(belonging));
  if (const auto numbers = keeper.restore(assembly, room))
    set_from(record, rig, particles, *numbers, checkpoint.file);
  const auto kept = [&] { return numbers_of(record, rig, particles, room.detector.rebuilds()); };

  std::vector<Held> held = held_in(particles);
  const std::string test = fmt::format("{} test", plan.facts.name);
  record.loop.start = std::chrono::steady_clock::now();
  for (bool over = false; !over;) {
    const Moment moment{record.steps, plan.step.time_step, plan.velocity, plan.rise_time};
    double work = 0;
    if (rig.steers()) {
      const double before = kinetic_energy(particles, held);
      if (rig.steer(particles, moment)) held = held_in(particles);
      work += kinetic_energy(particles, held) - before;
      for (const auto& [i, c] : held)
        room.max_speed = std::max(room.max_speed, particles.kinematics[i].velocity().norm());
    }
    const std::span<const dem::ElementLoad> loads = rig.loads(particles, moment);
    // Trapezia: what holds works against the forces at both ends of the motion, a load at both velocities.
    double power = power_of_holding(particles, held) + power_of_loads(particles, loads);
    const dem::StepSums sums = dem::advance(assembly, room, plan.step, loads);
    // `advance` moves with the velocities from before it; prescribed ones are still the same.
    power += power_of_holding(particles, held) + power_of_loads(particles, loads);
    work += 0.5 * power * plan.step.time_step;
    book_step(record, plan, rig, sums, work, particles);
    dem::watch_motion(assembly, room, sums, plan.step.time_step, record.steps, test);
    if (window_is_full(record, plan)) {
      close_window(record, plan, assembly, room);
      over = rig.is_over(so_far(record, plan));
      if (progress) progress(where_it_stands(record, plan, over));
    }
    if (!over) keeper.look(assembly, room, record.steps, kept);
  }
  return conclude(std::move(record), plan, rig, assembly, room);
}

}  // namespace virtual_tests
