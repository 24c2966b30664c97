#include "specimens/virtual_tests/spalling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libdem/core/error.h"
#include "libdem/motion/critical_step.h"
#include "libdem/probe/damage.h"
#include "libdem/run/watch.h"
#include "specimens/virtual_tests/bar_waves.h"
#include "specimens/virtual_tests/checkpoint_keeper.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/stopwatch.h"

namespace virtual_tests {
namespace {

/// A section of which so many links are broken has spalled [-]; a crack is never plane, so 1 is not reached.
constexpr double least_broken = 0.25;

/// Settled before the first step; the same inputs give the same plan.
struct Plan {
  int axis = 0;
  double nominal_speed = 0;  ///< of sound, sqrt(E / rho) of the card [m/s]
  double transit = 0;        ///< through the bar at that speed [s]
  PulseShape pulse = PulseShape::half_sine;
  double speed = 0;     ///< of the struck end, at the peak [m/s]
  double duration = 0;  ///< of the pulse [s]
  double rise = 0;
  double end_time = 0;  ///< [s]
};

double pulse_velocity(const Plan& plan, double time) {
  const double part = time / plan.duration;
  if (!(part > 0 && part < 1)) return 0;
  if (plan.pulse == PulseShape::half_sine) return plan.speed * std::sin(std::numbers::pi * part);
  return plan.speed * std::min({part / plan.rise, 1.0, (1 - part) / plan.rise});
}

Plan make_plan(const specimens::Specimen& specimen, const dem::MaterialCard& card,
               const SpallingOptions& options) {
  options.validate();
  Plan plan;
  plan.axis = loading_axis(specimen, options.axis);
  const double length = specimen.size[plan.axis];
  constexpr int least = 20;
  if (const int count = static_cast<int>(length / specimen.element_size()); count < least)
    throw dem::InputError("specimen", fmt::format("is only {} elements long", count),
                          fmt::format("a spalling bar has at least {} along its axis", least));
  plan.nominal_speed = std::sqrt(card.young_modulus / card.density);
  plan.transit = length / plan.nominal_speed;
  plan.pulse = options.pulse;
  plan.rise = options.rise;
  const double stress = options.incident_stress > 0 ? options.incident_stress : 4 * card.tensile_strength;
  plan.speed = options.velocity > 0 ? options.velocity : stress / (card.density * plan.nominal_speed);
  plan.duration = options.duration > 0 ? options.duration : 0.4 * plan.transit;
  plan.end_time = options.end_time > 0 ? options.end_time : 3 * plan.transit;
  // The pulse must have passed the gauge in the middle before it comes back, and be long for the elements.
  const double longest = 0.8 * plan.transit, shortest = 6 * specimen.element_size() / plan.nominal_speed;
  if (plan.duration > longest || plan.duration < shortest)
    throw dem::InputError("pulse-duration",
                          fmt::format("{:.4g} us does not suit this bar", 1e6 * plan.duration),
                          fmt::format("allowed: {:.4g} to {:.4g} us", 1e6 * shortest, 1e6 * longest));
  return plan;
}

/// Everything that changes from step to step besides the assembly.
struct Record {
  long steps = 0;
  BarHistory history;
  dem::EnergyLedger ledger;
  double worst_imbalance = 0;
  Film film;
  Stopwatch wall, loop;
};

dem::NamedNumbers numbers_of(const Record& record, const dem::Particles& particles,
                             const std::vector<std::int32_t>& struck) {
  const dem::EnergyLedger& l = record.ledger;
  dem::NamedNumbers numbers{{"steps", {static_cast<double>(record.steps)}},
                            {"time", record.history.time},
                            {"displacement", record.history.displacement},
                            {"velocity", record.history.velocity},
                            {"ledger", {l.external, l.kinetic, l.elastic, l.softening, l.sliding, l.damping}},
                            {"worst_imbalance", {record.worst_imbalance}},
                            {"wall_seconds", {record.wall.seconds()}},
                            {"loop_seconds", {record.loop.seconds()}}};
  for (const std::int32_t i : struck) {
    const double* force = particles.force[static_cast<std::size_t>(i)].value;
    numbers["struck_force"].insert(numbers["struck_force"].end(), force, force + 3);
  }
  record.film.keep_in(numbers);
  return numbers;
}

void set_from(Record& record, dem::Particles& particles, const std::vector<std::int32_t>& struck,
              const dem::NamedNumbers& numbers, const std::filesystem::path& file) {
  const auto column = [&](const char* name) -> const std::vector<double>& {
    return column_of(numbers, name, file, true);
  };
  const auto number = [&](const char* name) { return column_of(numbers, name, file)[0]; };
  record.steps = static_cast<long>(number("steps"));
  record.history = {column("time"), column("displacement"), column("velocity")};
  const std::vector<double>& l = column("ledger");
  if (l.size() == 6) record.ledger = {l[0], 0, l[1], l[2], l[3], l[4], l[5]};
  record.worst_imbalance = number("worst_imbalance");
  record.film.restore(numbers, file);
  record.wall.before = number("wall_seconds");
  record.loop.before = number("loop_seconds");
  const std::vector<double>& force = column("struck_force");
  for (std::size_t k = 0; k < struck.size() && 3 * k + 2 < force.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      particles.force[static_cast<std::size_t>(struck[k])].value[c] = force[3 * k + c];
}

/// The struck end: follows the pulse, then lets go. Returns the work of the change of velocity [J].
double strike(dem::Particles& particles, const std::vector<std::int32_t>& struck, const Plan& plan,
              double time) {
  const bool over = time >= plan.duration;
  const double velocity = pulse_velocity(plan, time);
  double work = 0;
  for (const std::int32_t number : struck) {
    const auto i = static_cast<std::size_t>(number);
    if (over) {
      particles.release(i, plan.axis);
      continue;
    }
    const double before = particles.kinematics[i].rate(plan.axis);
    work += 0.5 * particles.element_mass(i) * (velocity * velocity - before * before);
    particles.prescribe(i, plan.axis, velocity);
  }
  return work;
}

double power_of(const dem::Particles& particles, const std::vector<std::int32_t>& struck, int axis) {
  double power = 0;
  for (const std::int32_t number : struck) {
    const auto i = static_cast<std::size_t>(number);
    if (particles.is_prescribed(i, axis))
      power -= particles.force[i].value[axis] * particles.kinematics[i].rate(axis);
  }
  return power;
}

void read_energies(Record& record, dem::Assembly& assembly, const dem::StepRoom& room) {
  settle(assembly, room);
  read_pair_energies(record.ledger, assembly);
  record.worst_imbalance = std::max(record.worst_imbalance, std::abs(record.ledger.imbalance()));
  dem::watch_energy(record.ledger, record.steps, "spalling test");
}

/// Time is all that is driven here, and no one stress is the bar's.
void take_picture(Record& record, const dem::Assembly& assembly) {
  const double time = record.history.time.back();
  record.film.take(assembly, time, time, std::numeric_limits<double>::quiet_NaN());
}

/// The plane that broke: the earliest to be pulled far among those that are broken most.
std::size_t fracture_plane(const BarRecord& record, const std::vector<double>& broken, double far) {
  const double most = *std::max_element(broken.begin(), broken.end());
  std::size_t found = broken.size() - 1;
  double earliest = std::numeric_limits<double>::infinity();
  for (std::size_t plane = 1; plane < broken.size(); ++plane) {
    if (broken[plane] < 0.8 * most) continue;
    std::size_t r = 0;
    while (r < record.rows() && record.strain(r, plane) < far) ++r;
    const double time = r < record.rows() ? record.time(r) : record.time(record.rows() - 1);
    if (time < earliest) earliest = time, found = plane;
  }
  return found;
}

/// What is read from the histories, and the curve.
void measure(TestOutcome& outcome, const BarSlices& slices, const BarHistory& history, const Plan& plan,
             const dem::Assembly& assembly, double density, double static_strength) {
  const BarRecord record(slices, history);
  const std::size_t quarter = slices.at(0.25), middle = slices.at(0.5), free_end = slices.count() - 1;
  const double way = slices.length - slices.position[middle];
  // The pulse comes back to the middle after twice the way from there to the free end.
  const double back = (slices.position[middle] + 2 * way) / plan.nominal_speed;
  const double apart = slices.position[middle] - slices.position[quarter];
  const double late = record.crest_time(middle, back) - record.crest_time(quarter, back);
  const double speed = late > 0 ? apart / late : 0, impedance = density * speed;
  const double incident_velocity = record.highest_velocity(middle, back);

  const PullBack pull = pull_back_of(record, free_end, 2 * plan.transit);
  double reflected = 0;
  for (std::size_t r = 0; r < record.rows(); ++r)
    if (record.time(r) > back && record.time(r) < back + plan.transit)
      reflected = std::max(reflected, impedance * speed * record.strain(r, middle));

  const std::vector<double> broken = broken_part_below(slices, assembly.law, assembly.links);
  const bool spalled = *std::max_element(broken.begin(), broken.end()) >= least_broken;
  const double spall_strength = spalled ? 0.5 * impedance * pull.drop : 0;
  const double thickness = slices.length / static_cast<double>(slices.count());
  const double window = thickness / plan.nominal_speed;
  std::size_t plane = free_end;
  if (spalled) {
    plane = fracture_plane(record, broken, 3 * spall_strength / (impedance * speed));
  } else {  // nothing broke: where the tension was highest
    double highest = 0;
    for (std::size_t k = 1; k < slices.count(); ++k) {
      const std::vector<double> stress = record.stress_below(k, window);
      const double top = *std::max_element(stress.begin(), stress.end());
      if (top > highest) highest = top, plane = k;
    }
  }
  const std::vector<double> stress = record.stress_below(plane, window);
  const double fracture_stress = *std::max_element(stress.begin(), stress.end());
  const double rise = rise_time(history.time, stress);

  outcome.measured = {{"spall_strength", spall_strength},
                      {"fracture_stress", fracture_stress},
                      {"strain_rate", rise > 0 && speed > 0 ? fracture_stress / (impedance * speed) / rise : 0},
                      {"fracture_position", thickness * static_cast<double>(slices.count() - plane)},
                      {"fracture_damage", broken[plane]},
                      {"pull_back_velocity", spalled ? pull.drop : 0},
                      {"free_end_velocity", pull.peak},
                      {"incident_velocity", incident_velocity},
                      {"incident_stress", impedance * incident_velocity},
                      {"reflected_stress", reflected},
                      {"wave_speed", speed}};
  if (static_strength > 0)
    outcome.measured.emplace_back("dynamic_increase_factor", spall_strength / static_strength);
  outcome.curve.columns = {{"time", "s"},
                           {"free_end_velocity", "m/s"},
                           {"fracture_stress", "Pa"},
                           {"gauge_strain", "-"},
                           {"gauge_velocity", "m/s"}};
  for (std::size_t r = 0; r < record.rows(); ++r)
    outcome.curve.values.insert(outcome.curve.values.end(),
                                {record.time(r), record.velocity(r, free_end), stress[r],
                                 record.strain(r, middle), record.velocity(r, middle)});
  outcome.run->passed_peak = spalled;
}

}  // namespace

void SpallingOptions::validate() const {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw dem::InputError(key, fmt::format("{} is out of range", value), fmt::format("allowed: {}", allowed));
  };
  if (!(incident_stress >= 0)) refuse("pulse-stress", incident_stress, "positive");
  if (!(velocity >= 0)) refuse("velocity", velocity, "positive");
  if (!(duration >= 0)) refuse("pulse-duration", duration, "positive");
  if (!(rise > 0 && rise <= 0.5)) refuse("rise", rise, "above 0, at most 0.5 (part of the duration)");
  if (!(static_strength >= 0)) refuse("static-strength", static_strength, "positive");
  if (!(end_time >= 0)) refuse("end-time", end_time, "positive");
  if (!(time_step_fraction > 0 && time_step_fraction < 1))
    refuse("time step fraction", time_step_fraction, "above 0, below 1 (the critical time step)");
  if (threads < 1) refuse("threads", threads, "1 or more");
}

void check_spalling(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                    const SpallingOptions& options) {
  const Plan plan = make_plan(specimen, card, options);
  cut_bar(make_assembly(specimen, card).particles, plan.axis, specimen.size[plan.axis],
          specimen.section(plan.axis), specimen.element_size());
}

TestOutcome run_spalling(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                         const SpallingOptions& options, const std::string& sha256_of_options,
                         const dem::ProgressCallback& progress, const CheckpointPolicy& checkpoint) {
  Record record;
  record.film = Film(checkpoint.pictures);
  const Plan plan = make_plan(specimen, card, options);
  dem::Assembly assembly = make_assembly(specimen, card);
  dem::Particles& particles = assembly.particles;
  const BarSlices slices = cut_bar(particles, plan.axis, specimen.size[plan.axis], specimen.section(plan.axis),
                                   specimen.element_size());
  const double critical = dem::critical_time_step(link_network(specimen, assembly), particles);
  const dem::StepOptions step{options.time_step_fraction * critical, {}, options.threads};
  const long all_steps = std::lround(std::ceil(plan.end_time / step.time_step));
  const long stride =
      std::max(1L, static_cast<long>(std::min(plan.duration / 100, slices.length / plan.nominal_speed / 200) /
                                     step.time_step));
  std::vector<std::int32_t> struck;
  for (std::size_t i = 0; i < particles.count; ++i)
    if (particles.initial_position[i][plan.axis] < specimen.element_size())
      struck.push_back(static_cast<std::int32_t>(i));

  dem::StepRoom room(assembly);
  dem::Belonging belonging;
  if (!checkpoint.file.empty())
    belonging = {{"specimen", specimen.sha256()}, {"card", sha256_of(card)}, {"options", sha256_of_options}};
  CheckpointKeeper keeper(checkpoint, std::move(belonging));
  if (const auto numbers = keeper.restore(assembly, room))
    set_from(record, particles, struck, *numbers, checkpoint.file);
  const auto kept = [&] { return numbers_of(record, particles, struck); };

  record.loop.start = std::chrono::steady_clock::now();
  while (record.steps < all_steps) {
    const double middle_of_step = step.time_step * (static_cast<double>(record.steps) + 0.5);
    double work = strike(particles, struck, plan, middle_of_step);
    room.max_speed = std::max(room.max_speed, std::abs(pulse_velocity(plan, middle_of_step)));
    // Trapezia: the end works against the forces at both ends of its motion.
    double power = power_of(particles, struck, plan.axis);
    const dem::StepSums sums = dem::advance(assembly, room, step);
    power += power_of(particles, struck, plan.axis);
    work += 0.5 * power * step.time_step;
    ++record.steps;
    dem::watch_motion(assembly, room, sums, step.time_step, record.steps, "spalling test");
    record.ledger.external += work;
    record.ledger.sliding += sums.sliding;
    record.ledger.kinetic = sums.kinetic;
    if (record.steps % stride == 0) {
      add_row(record.history, slices, particles, step.time_step * static_cast<double>(record.steps));
      const double last = record.history.velocity.back();
      if (record.history.time.size() % 10 == 0) {
        read_energies(record, assembly, room);
        if (record.film.is_due()) take_picture(record, assembly);
      }
      if (progress)
        progress({"spalling", static_cast<double>(record.steps), static_cast<double>(all_steps), "steps",
                  fmt::format("free end {:.3f} m/s", last)});
    }
    if (record.steps < all_steps) keeper.look(assembly, room, record.steps, kept);
  }

  TestOutcome outcome;
  StepsTaken& run = outcome.run.emplace();
  run.step_loop_seconds = record.loop.seconds();
  read_energies(record, assembly, room);
  run.dynamic = true;
  run.steps = record.steps;
  run.time_step = step.time_step;
  run.critical_time_step = critical;
  run.velocity = plan.speed;
  run.energy_balance_error = record.worst_imbalance / std::max(std::abs(record.ledger.external), 1e-300);
  run.links = assembly.links.count;
  run.broken_links = dem::broken_links(assembly.law, assembly.links);
  run.state_sha256 = dem::state_sha256(assembly);
  outcome.setting = {{"axis", std::string(1, "xyz"[plan.axis])},
                     {"pulse", std::string(plan.pulse == PulseShape::half_sine ? "half-sine" : "trapezoid")},
                     {"pulse_duration", plan.duration}};
  measure(outcome, slices, record.history, plan, assembly, card.density, options.static_strength);
  outcome.fields = final_fields(assembly);
  take_picture(record, assembly);
  outcome.fields.film = std::move(record.film);
  outcome.wall_seconds = record.wall.seconds();
  return outcome;
}

}  // namespace virtual_tests
