#include "impact/impact_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "impact/coupling/discrete_side.h"
#include "impact/model.h"
#include "impact/run_record.h"
#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/probe/damage.h"
#include "libdem/run/checkpoint.h"
#include "libdem/run/checkpoint_interval.h"
#include "libdem/run/watch.h"

namespace impact {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Energy that may appear from nowhere, as a part of what there was at the start, before a run stops itself. An
/// undamped run keeps its balance to a few tenths of a percent.
constexpr double allowed_growth = 0.03;

/// Energies and damage take a pass over all links, as dear as a step or two: they are read at the first sample
/// after so many steps.
constexpr std::int64_t steps_between_stocks = 100;

/// Steps between two looks for nodes that are lost; elements are watched in every step.
constexpr std::int64_t steps_between_looks_at_nodes = 50;

/// A run under way: the scene, what moves, what is noted down.
struct Run {
  const Scene& scene;
  int threads;
  ImpactModel model;
  dem::StepRoom room;
  dem::StepOptions options;
  ImpactorState impactor;
  ImpactorRoom impactor_room;
  std::vector<dem::ElementLoad> loads;
  RunRecord record;
  std::int64_t total_steps, steps_per_sample, steps_per_stock;

  const Impactor* body() const { return scene.impactor ? &*scene.impactor : nullptr; }
  double time() const { return static_cast<double>(record.steps) * model.time_step; }

  Run(const Scene& its_scene, int its_threads, ImpactModel made)
      : scene(its_scene),
        threads(its_threads),
        model(std::move(made)),
        room(model.assembly),
        record(sample_interval(its_scene)) {
    require_sensible_step();
    options.time_step = model.time_step;
    options.damping.factor = scene.damping;
    options.threads = threads;
    // Finite elements that go with every m-th step have their energy in step with the others' once every m
    // steps, in the step that moves them: stock is taken then, and at the end.
    const std::int64_t together = model.finite ? model.finite->sub_stepping.interval() : 1;
    const auto multiple = [](std::int64_t of, std::int64_t at_least) { return (at_least + of - 1) / of * of; };
    total_steps =
        1 + multiple(together, std::max<std::int64_t>(1, std::llround(scene.duration / model.time_step) - 1));
    steps_per_sample = std::max<std::int64_t>(1, std::llround(sample_interval(scene) / model.time_step));
    steps_per_stock = multiple(together, steps_between_stocks);
    if (scene.impactor) {
      impactor = start_of(scene, model);
      const Motion& motion = impactor.motion;
      const Vec3 spin = motion.orientation.conjugate() * motion.spin;
      record.energy.initial = 0.5 * scene.impactor->body.mass * motion.velocity.squaredNorm() +
                              0.5 * spin.dot(scene.impactor->body.inertia * spin);
      record.energy.impactor = record.energy.initial;
    }
    record.first_momentum = momentum_of(model, body(), impactor);
  }

  /// Contacts that nothing can follow, and an impactor that passes elements between two steps.
  void require_sensible_step() const {
    constexpr double most_steps = 1e9;
    if (!(scene.duration / model.time_step <= most_steps))
      throw dem::InputError(
          "run.duration",
          fmt::format("takes {:.3g} steps of {:.3g} s", scene.duration / model.time_step, model.time_step),
          "a thousand million at most: the duration is long, or a contact or the concrete very stiff");
    if (!scene.impactor) return;
    const double way = scene.approach.speed * model.time_step;
    if (!(way < room.smallest_radius))
      throw dem::InputError(
          "impactor.speed",
          fmt::format("carries it {:.3g} m in one step of {:.3g} s, past elements of radius {:.3g} m", way,
                      model.time_step, room.smallest_radius),
          "lower it, or run.time_step_fraction");
  }

  static double sample_interval(const Scene& scene) {
    return scene.sample_interval > 0 ? scene.sample_interval : scene.duration / 2000;
  }
};

/// The phases of one step, in order.
/// Stops a run whose finite elements move by what is no number.
void watch_nodes(const Run& run) {
  const FiniteDomain& finite = *run.model.finite;
  for (std::size_t i = 0; i < finite.mesh.nodes.size(); ++i) {
    if (finite.nodes.velocity[i].allFinite() && finite.nodes.displacement[i].allFinite()) continue;
    const Vec3& at = finite.mesh.nodes[i];
    throw dem::RunError(fmt::format(
        "the impact diverged by step {}: node {} of the finite elements, at ({:.4g}, {:.4g}, {:.4g}) m, moves "
        "by what is no number; lower run.time_step_fraction",
        run.record.steps, i, at.x(), at.y(), at.z()));
  }
}

StepTaken advance(Run& run) {
  ImpactModel& model = run.model;
  dem::Particles& particles = model.assembly.particles;
  StepTaken taken;
  if (run.scene.impactor) {
    taken.impactor =
        advance_impactor(*run.scene.impactor, run.impactor, run.impactor_room, particles,
                         {.time_step = model.time_step, .max_speed = run.room.max_speed}, run.loads);
    run.record.force.add(run.time() + model.time_step, model.time_step, taken.impactor.force);
  }
  taken.elements = dem::advance(model.assembly, run.room, run.options, run.loads);
  if (model.finite) {
    FiniteDomain& finite = *model.finite;
    fe::advance_positions(finite.nodes, model.time_step, run.threads);
    finite.sub_stepping.advance_velocities(*finite.body, finite.nodes, run.record.steps, model.time_step,
                                           run.threads);
    const Clock::time_point start = Clock::now();
    const coupling::TieSums tied =
        finite.ties.apply(coupling::velocities(particles), finite.nodes, model.time_step);
    run.record.overlap_seconds += seconds_since(start);
    run.room.max_speed = std::max(run.room.max_speed, std::sqrt(tied.max_speed_squared));
    // A strict tie's impulses do no work over a step, whatever they do to the velocity at its end.
    const Surroundings& around = *run.scene.surroundings;
    if (around.solve == coupling::MultiplierSolve::lumped || around.relaxation_time > model.time_step)
      taken.ties_change = tied.kinetic_change;
  }
  book_supports(run.record, model);
  book_step(run.record, taken);
  ++run.record.steps;
  dem::watch_motion(model.assembly, run.room, taken.elements, model.time_step, run.record.steps, "impact");
  if (model.finite && run.record.steps % steps_between_looks_at_nodes == 0) watch_nodes(run);
  return taken;
}

/// Where damage has come closest to the finite elements.
void look_at_overlap(Run& run) {
  const dem::Assembly& assembly = run.model.assembly;
  const dem::Links& links = assembly.links;
  for (std::size_t k = 0; k < links.count; ++k) {
    if (!assembly.law.is_broken(links.max_strain[k])) continue;
    const Vec3 middle = 0.5 * (assembly.particles.initial_position[static_cast<std::size_t>(links.a[k])] +
                               assembly.particles.initial_position[static_cast<std::size_t>(links.b[k])]);
    const double place = run.model.finite->zone.overlap_coordinate(middle);
    if (place > run.record.farthest_damage)
      run.record.farthest_damage = place, run.record.damage_place = middle;
  }
}

/// Stops a run that has gone wrong, and says where.
void watch(const Run& run) {
  const ImpactEnergy& energy = run.record.energy;
  const bool lost = !std::isfinite(energy.final_sum());
  if (!lost && energy.imbalance() >= -allowed_growth * energy.initial) return;
  const dem::Particles& particles = run.model.assembly.particles;
  std::size_t worst = 0;
  double fastest = -1;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double speed = particles.kinematics[i].velocity().norm();
    if (!(speed <= fastest)) worst = i, fastest = std::isnan(speed) ? fastest : speed;
    if (std::isnan(speed)) break;
  }
  const Vec3& at = particles.initial_position[worst];
  throw dem::RunError(fmt::format(
      "{} at step {} ({:.4g} s), first at element {} near ({:.4g}, {:.4g}, {:.4g}) m; lower "
      "run.time_step_fraction",
      lost ? "the impact diverged: its energy is no number"
           : fmt::format("energy grew by {:.1f}% without cause", -100 * energy.imbalance() / energy.initial),
      run.record.steps, run.time(), worst, at.x(), at.y(), at.z()));
}

/// What takes a pass over all links: energies, damage, momentum.
void take_stock(Run& run, const StepTaken& taken, const std::vector<Vec3>& nodes_before) {
  RunRecord& record = run.record;
  dem::settle(run.model.assembly, run.room);
  read_energies(record, run.model, taken, run.room.next, nodes_before);
  watch(run);
  const Vec3 departure =
      momentum_of(run.model, run.body(), run.impactor) - record.first_momentum - record.support_impulse;
  record.worst_momentum = std::max(record.worst_momentum, departure.norm());
  record.broken_links = dem::broken_links(run.model.assembly.law, run.model.assembly.links);
  if (run.model.finite) look_at_overlap(run);
}

void take_sample(Run& run) {
  RunRecord& record = run.record;
  Sample sample;
  sample.time = run.time();
  for (const ProbePlace& place : run.model.probes)
    sample.displacement.push_back(run.model.displacement_at(place));
  const double since = record.history.empty() ? sample.time : sample.time - record.history.back().time;
  if (since > 0) sample.force = (record.force.impulse() - record.impulse_at_sample) / since;
  record.impulse_at_sample = record.force.impulse();
  sample.impactor_position = run.impactor.motion.position;
  sample.impactor_velocity = run.impactor.motion.velocity;
  sample.broken_links = record.broken_links;
  sample.energy = record.energy;
  record.history.push_back(std::move(sample));
}

void show(Run& run, const FrameCallback& frame, int number) {
  if (!frame) return;
  dem::settle(run.model.assembly, run.room);
  const FiniteDomain* finite = run.model.finite.get();
  frame({number, run.time(), &run.model.assembly, finite != nullptr ? &finite->mesh : nullptr,
         finite != nullptr ? &finite->nodes : nullptr, pose_of(run.impactor.motion)});
}

/// What a checkpoint belongs to: the files that the scene was read from, as they were then, and the structure
/// that they gave.
dem::Belonging belonging_of(const Scene& scene, const ImpactModel& model) {
  dem::Belonging belonging;
  for (const dem::InputFile& input : scene.inputs) belonging.emplace_back(input.what, input.sha256);
  belonging.emplace_back("specimen", model.specimen.sha256());
  return belonging;
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
  return numbers;
}

void set_vectors(std::vector<Vec3>& vectors, const std::vector<double>& numbers, const std::string& where) {
  if (numbers.size() != 3 * vectors.size())
    throw dem::InputError(where, "has another number of nodes", "start anew without --resume");
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

void keep(Run& run, const std::filesystem::path& file, const dem::Belonging& belonging) {
  dem::NamedNumbers numbers = numbers_of(run.record, run.scene.probes.size());
  if (run.scene.impactor)
    for (auto& [name, values] : to_numbers(run.impactor)) numbers["impactor " + name] = values;
  if (run.model.finite) {
    numbers["node displacement"] = flat(run.model.finite->nodes.displacement);
    numbers["node velocity"] = flat(run.model.finite->nodes.velocity);
  }
  dem::write_checkpoint(file, belonging, run.model.assembly, run.room, numbers);
}

void go_on_from(Run& run, const std::filesystem::path& file, const dem::Belonging& belonging) {
  const dem::NamedNumbers numbers = dem::read_checkpoint(file, belonging, run.model.assembly, run.room);
  set_from(run.record, numbers, run.scene.probes.size(), file.string());
  if (run.scene.impactor) {
    constexpr std::string_view prefix = "impactor ";
    std::map<std::string, std::vector<double>> own;
    for (const auto& [name, values] : numbers)
      if (name.starts_with(prefix)) own[name.substr(prefix.size())] = values;
    run.impactor = from_numbers(own, file.string());
  }
  if (run.model.finite) {
    const auto column = [&](const std::string& name) {
      const auto found = numbers.find(name);
      return found != numbers.end() ? found->second : std::vector<double>{};
    };
    set_vectors(run.model.finite->nodes.displacement, column("node displacement"), file.string());
    set_vectors(run.model.finite->nodes.velocity, column("node velocity"), file.string());
  }
}

/// The slab that the impactor strikes: the faces across the axis that it comes along.
Slab slab_of(const Scene& scene) {
  int axis = 0;
  scene.approach.direction.cwiseAbs().maxCoeff(&axis);
  Slab slab;
  const bool downward = scene.approach.direction[axis] < 0;
  slab.front = scene.approach.aim;
  slab.front[axis] = downward ? scene.size[axis] : 0;
  slab.outward = Vec3::Zero();
  slab.outward[axis] = downward ? 1 : -1;
  slab.thickness = scene.size[axis];
  return slab;
}

void conclude_damage(ImpactResult& result, const Run& run) {
  const dem::Assembly& assembly = run.model.assembly;
  const dem::Particles& particles = assembly.particles;
  result.broken_links = dem::broken_links(assembly.law, assembly.links);
  const std::vector<double> damage = dem::element_damage(assembly.law, assembly.links, particles.count);
  for (std::size_t i = 0; i < particles.count; ++i)
    if (damage[i] > 0.5)
      result.damage_volume += 4.0 / 3 * M_PI * std::pow(particles.radius[i], 3) / run.model.solid_fraction;

  std::vector<Vec3> position, velocity;
  std::vector<double> mass;
  for (std::size_t i = 0; i < particles.count; ++i) {
    position.push_back(particles.kinematics[i].position());
    velocity.push_back(particles.kinematics[i].velocity());
    mass.push_back(particles.element_mass(i));
  }
  std::vector<std::uint8_t> broken;
  for (std::size_t k = 0; k < assembly.links.count; ++k)
    broken.push_back(assembly.law.is_broken(assembly.links.max_strain[k]) ? 1 : 0);
  const std::size_t links = assembly.links.count;
  result.fragments =
      find_fragments({position, velocity, particles.radius, mass},
                     {{assembly.links.a.data(), links}, {assembly.links.b.data(), links}, broken});
  if (!run.scene.impactor) return;
  const Slab slab = slab_of(run.scene);
  result.losses = find_losses(slab, result.fragments, particles.initial_position, particles.radius, mass,
                              run.model.solid_fraction);
  const Motion& motion = run.impactor.motion;
  const Vec3 inward = motion.orientation.conjugate() * -slab.outward;
  result.impactor =
      judge(slab, motion.position, motion.velocity, reach_along(run.scene.impactor->shape, inward),
            reach_along(run.scene.impactor->shape, -inward));
}

void conclude_warnings(ImpactResult& result, const Run& run) {
  const RunRecord& record = run.record;
  result.warnings = run.model.warnings;
  if (record.farthest_damage > 0) {
    const Vec3& at = record.damage_place;
    const double deep = record.farthest_damage * run.model.finite->zone.thickness;
    result.warnings.push_back(
        fmt::format("damage reached the overlap, {:.3g} m into it near ({:.3g}, {:.3g}, {:.3g}) m: enlarge the "
                    "zone of discrete "
                    "elements there by {:.2g} m or more",
                    deep, at.x(), at.y(), at.z(), deep + run.model.specimen.element_size()));
  }
  if (result.energy_balance_error > 0.01)
    result.warnings.push_back(
        fmt::format("the energy balance is open by {:.1f}% of the initial energy; lower "
                    "run.time_step_fraction to see whether results change",
                    100 * result.energy_balance_error));
}

ImpactResult conclude(Run& run, Clock::time_point start) {
  dem::settle(run.model.assembly, run.room);
  const RunRecord& record = run.record;
  ImpactResult result;
  result.elements = run.model.assembly.particles.count;
  result.nodes = run.model.finite ? run.model.finite->mesh.nodes.size() : 0;
  result.links = run.model.assembly.links.count;
  if (run.model.finite) {
    result.finite_young_modulus = run.model.finite->material_young_modulus;
    result.finite_poisson_ratio = run.model.finite->material_poisson_ratio;
    result.interval = run.model.finite->sub_stepping.interval();
  }
  result.contacts = run.model.assembly.contacts.count;
  result.steps = static_cast<long>(record.steps);
  result.time_step = run.model.time_step;
  result.critical_time_step = run.model.critical_time_step;
  result.simulated_time = run.time();
  result.history = record.history;
  for (std::size_t p = 0; p < run.scene.probes.size(); ++p) {
    double largest = 0;
    for (const Sample& sample : record.history) largest = std::max(largest, sample.displacement[p].norm());
    result.max_displacement[run.scene.probes[p].name] = largest;
  }
  result.peak_force = record.force.peak_mean_force();
  result.impulse = record.force.impulse();
  result.residual_velocity = run.impactor.motion.velocity.dot(run.scene.approach.direction);
  result.energy = record.energy;
  result.energy_balance_error = record.energy.initial > 0 ? record.worst_imbalance / record.energy.initial : 0;
  const double momentum = record.first_momentum.norm();
  result.momentum_error = momentum > 0 ? record.worst_momentum / momentum : 0;
  conclude_damage(result, run);
  conclude_warnings(result, run);
  result.state_sha256 = dem::state_sha256(run.model.assembly);
  result.step_loop_seconds = record.loop_seconds;
  result.overlap_solve_seconds = record.overlap_seconds;
  result.wall_seconds = record.wall_seconds + seconds_since(start);
  return result;
}

}  // namespace

ImpactResult run_impact(const Scene& scene, int threads, const dem::ProgressCallback& progress,
                        const FrameCallback& frame, const ImpactCheckpoint& checkpoint) {
  const Clock::time_point start = Clock::now();
  Run run(scene, threads, make_model(scene, threads, progress));
  const dem::Belonging belonging = checkpoint.file.empty() ? dem::Belonging{} : belonging_of(scene, run.model);
  if (checkpoint.resume && std::filesystem::exists(checkpoint.file))
    go_on_from(run, checkpoint.file, belonging);
  if (run.record.steps == 0) {
    take_sample(run);
    if (scene.frames > 0) show(run, frame, 0);
  }

  Clock::time_point loop = Clock::now(), told = loop;
  dem::CheckpointPace pace(checkpoint.interval);
  const auto book_time = [&] {
    run.record.loop_seconds += seconds_since(loop);
    loop = Clock::now();
  };
  std::vector<Vec3> nodes_before;
  while (run.record.steps < run.total_steps) {
    const std::int64_t next = run.record.steps + 1;
    const bool sampled = next % run.steps_per_sample == 0 || next == run.total_steps;
    const bool stock = (next > 1 && (next - 1) % run.steps_per_stock == 0) || next == run.total_steps;
    if (stock && run.model.finite) nodes_before = run.model.finite->nodes.velocity;
    const StepTaken taken = advance(run);
    if (stock) take_stock(run, taken, nodes_before);
    if (sampled) take_sample(run);
    if (scene.frames > 0) {
      const auto number_at = [&](std::int64_t step) { return step * scene.frames / run.total_steps; };
      if (number_at(next) > number_at(next - 1)) show(run, frame, static_cast<int>(number_at(next)));
    }
    if (progress && (sampled || next == run.total_steps) &&
        (seconds_since(told) > 0.2 || next == run.total_steps)) {
      told = Clock::now();
      progress({"impact", static_cast<double>(next), static_cast<double>(run.total_steps), "steps",
                fmt::format("{:.3g} ms, {} links broken", 1e3 * run.time(),
                            run.record.history.empty() ? 0 : run.record.history.back().broken_links)});
    }
    const bool stop = dem::interrupt_requested();
    if (!checkpoint.file.empty() && (stop || pace.is_due())) {
      book_time();
      const double before = run.record.wall_seconds;
      run.record.wall_seconds += seconds_since(start);
      pace.keep([&] { keep(run, checkpoint.file, belonging); });
      run.record.wall_seconds = before;
    }
    if (stop)
      throw dem::Interrupted(checkpoint.file.empty() ? "stopped by a signal"
                                                     : fmt::format("stopped by a signal at step {}", next));
  }
  book_time();
  return conclude(run, start);
}

}  // namespace impact
