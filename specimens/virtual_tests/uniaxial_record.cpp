#include "specimens/virtual_tests/uniaxial_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/probe/damage.h"
#include "libdem/run/watch.h"

namespace virtual_tests {
namespace {

/// Reads the gauge at the window's middle: a stress sampled later than its strain would bias the modulus.
void read_gauge(UniaxialRecord& record, const UniaxialPlan& plan, const dem::Particles& particles) {
  const dem::AxialStrains strain = plan.gauge.measure(particles);
  const auto a = static_cast<std::size_t>(plan.axis);
  record.point.strain = plan.strain_after(record.steps);
  record.point.strain_axial = -plan.sign * strain[a];
  record.point.strain_lateral = -plan.sign * 0.5 * (strain[(a + 1) % 3] + strain[(a + 2) % 3]);
}

}  // namespace

void book_step(UniaxialRecord& record, const UniaxialPlan& plan, const dem::StepSums& sums,
               const dem::Particles& particles) {
  ++record.steps;
  dem::EnergyLedger& ledger = record.ledger;
  ledger.sliding += sums.sliding;
  ledger.damping += sums.damped;
  ledger.kinetic = sums.kinetic;
  const double low = plan.platens.low_reaction(particles), high = plan.platens.high_reaction(particles);
  // The platens close at half the speed each; their work is the mean reaction over the step times the way.
  const double reaction = plan.sign * 0.5 * (low + high);
  ledger.external += 0.5 * (reaction + record.previous_reaction) * plan.velocity * plan.step.time_step;
  record.friction.feel(particles);
  ledger.external += record.friction.work() - record.friction_work;
  record.friction_work = record.friction.work();
  record.previous_reaction = reaction;
  record.low += plan.sign * low;
  record.high += plan.sign * high;
  ++record.window_steps;
  if (record.window_steps == plan.half_window + 1) read_gauge(record, plan, particles);
}

bool window_is_full(const UniaxialRecord& record, const UniaxialPlan& plan) {
  return record.window_steps == plan.window_steps();
}

void close_window(UniaxialRecord& record, const UniaxialPlan& plan, dem::Assembly& assembly,
                  const dem::StepRoom& room) {
  CurvePoint& point = record.point;
  const double n = static_cast<double>(plan.window_steps()) * plan.section;
  point.stress = 0.5 * (record.low + record.high) / n;
  point.unbalanced = std::abs(record.low - record.high) /
                     std::max(std::abs(record.low + record.high) / 2, 1e-3 * plan.expected_strength * n);
  record.low = record.high = 0;
  record.window_steps = 0;
  const std::size_t windows = record.curve.size();
  if (windows % 4 == 0) {  // these pass over all links
    settle(assembly, room);
    read_pair_energies(record.ledger, assembly);
    record.worst_imbalance = std::max(record.worst_imbalance, std::abs(record.ledger.imbalance()));
    dem::watch_energy(record.ledger, record.steps, fmt::format("{} test", name_of(plan.loading)));
    point.broken = static_cast<double>(dem::broken_links(assembly.law, assembly.links)) /
                   static_cast<double>(assembly.links.count);
    if (record.film.is_due())
      record.film.take(assembly, plan.step.time_step * static_cast<double>(record.steps), point.strain,
                       point.stress);
  }
  record.curve.push_back(point);
  if (point.stress > record.peak) record.peak = point.stress, record.peak_index = windows;
}

bool has_fallen(const UniaxialRecord& record, const UniaxialPlan& plan) {
  const CurvePoint& last = record.curve.back();
  return last.stress < plan.stop_at * record.peak &&
         last.strain > 1.02 * record.curve[record.peak_index].strain && record.peak > plan.least_peak;
}

bool is_over(const UniaxialRecord& record, const UniaxialPlan& plan) {
  return has_fallen(record, plan) || record.curve.back().strain >= plan.max_strain;
}

UniaxialResult conclude(UniaxialRecord&& record, const UniaxialPlan& plan, dem::Assembly& assembly,
                        const dem::StepRoom& room) {
  UniaxialResult result;
  result.step_loop_seconds = record.loop.seconds();
  settle(assembly, room);
  read_pair_energies(record.ledger, assembly);
  result.energy = record.ledger;
  result.energy_balance_error = record.worst_imbalance / std::max(std::abs(record.ledger.external), 1e-300);
  result.peak_stress = record.peak;
  result.peak_strain = record.curve[record.peak_index].strain;
  const double last = record.curve.back().stress;
  result.passed_peak = has_fallen(record, plan) || record.peak < 0.95 * last || last < 0.95 * record.peak;
  for (std::size_t k = 0; k <= record.peak_index; ++k)
    if (record.curve[k].stress > 0.5 * record.peak)
      result.unbalanced_force_ratio = std::max(result.unbalanced_force_ratio, record.curve[k].unbalanced);
  const Moduli moduli = moduli_of(record.curve);
  result.young_modulus = moduli.young_modulus;
  result.poisson_ratio = moduli.poisson_ratio;
  result.work_of_fracture = work_of_fracture(record.curve, plan.platens.gauge_length, moduli.young_modulus);
  result.curve = std::move(record.curve);

  result.steps = record.steps;
  result.time_step = plan.step.time_step;
  result.critical_time_step = plan.critical_time_step;
  result.velocity = plan.velocity;
  result.links = assembly.links.count;
  result.broken_links = dem::broken_links(assembly.law, assembly.links);
  result.contacts = assembly.contacts.count;
  static_cast<FinalFields&>(result) = final_fields(assembly);
  record.film.take(assembly, plan.step.time_step * static_cast<double>(record.steps),
                   result.curve.back().strain, last);
  result.film = std::move(record.film);
  result.detector_rebuilds = record.rebuilds + room.detector.rebuilds();
  result.state_sha256 = dem::state_sha256(assembly);
  result.wall_seconds = record.wall.seconds();
  return result;
}

}  // namespace virtual_tests
