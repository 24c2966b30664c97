#include "specimens/virtual_tests/rig_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/probe/damage.h"
#include "libdem/run/watch.h"

namespace virtual_tests {

RigRecord::RigRecord(const RigFacts& facts, int pictures) : extra(facts.extra.size(), 0.0), film(pictures) {
  curve.columns = {facts.control, {"force", "N"}, {"stress", "Pa"}};
  curve.columns.insert(curve.columns.end(), facts.extra.begin(), facts.extra.end());
  curve.columns.push_back({"broken", "-"});
  curve.columns.push_back({"unbalanced", "-"});
}

void book_step(RigRecord& record, const RigPlan& plan, const Rig& rig, const dem::StepSums& sums, double work,
               const dem::Particles& particles) {
  ++record.steps;
  dem::EnergyLedger& ledger = record.ledger;
  ledger.sliding += sums.sliding;
  ledger.damping += sums.damped;
  ledger.kinetic = sums.kinetic;
  ledger.external += work;
  const Reading reading = rig.read(particles);
  record.force += reading.force;
  record.opposing += reading.opposing;
  ++record.window_steps;
  if (record.window_steps != plan.half_window + 1) return;
  // A force averaged over the window belongs to its middle: so must all else.
  record.control = reading.control;
  rig.sample(particles, record.extra);
}

bool window_is_full(const RigRecord& record, const RigPlan& plan) {
  return record.window_steps == plan.window_steps();
}

void close_window(RigRecord& record, const RigPlan& plan, dem::Assembly& assembly, const dem::StepRoom& room) {
  const auto n = static_cast<double>(plan.window_steps());
  const double force = 0.5 * (record.force + record.opposing) / n;
  const double unbalanced = std::abs(record.force - record.opposing) / n /
                            std::max(std::abs(force), 1e-3 * std::abs(plan.expected_force));
  record.force = record.opposing = 0;
  record.window_steps = 0;
  const std::size_t windows = record.shape.size();
  const double stress = force * plan.facts.stress_per_force;
  if (windows % 4 == 0) {  // these pass over all links
    settle(assembly, room);
    read_pair_energies(record.ledger, assembly);
    record.worst_imbalance = std::max(record.worst_imbalance, std::abs(record.ledger.imbalance()));
    dem::watch_energy(record.ledger, record.steps, fmt::format("{} test", plan.facts.name));
    record.broken = static_cast<double>(dem::broken_links(assembly.law, assembly.links)) /
                    static_cast<double>(assembly.links.count);
    if (record.film.is_due())
      record.film.take(assembly, plan.step.time_step * static_cast<double>(record.steps), record.control,
                       stress);
  }
  std::vector<double>& values = record.curve.values;
  values.insert(values.end(), {record.control, force, stress});
  values.insert(values.end(), record.extra.begin(), record.extra.end());
  values.insert(values.end(), {record.broken, unbalanced});
  CurvePoint point;
  point.strain = record.control, point.stress = stress, point.unbalanced = unbalanced;
  record.shape.push_back(point);
  if (stress > record.peak) record.peak = stress, record.peak_index = windows;
}

SoFar so_far(const RigRecord& record, const RigPlan& plan) {
  const CurvePoint& last = record.shape.back();
  return {record.curve, last.strain,  last.stress, record.peak, record.shape[record.peak_index].strain,
          plan.stop_at, plan.furthest};
}

TestOutcome conclude(RigRecord&& record, const RigPlan& plan, const Rig& rig, dem::Assembly& assembly,
                     const dem::StepRoom& room) {
  TestOutcome outcome;
  StepsTaken& run = outcome.run.emplace();
  run.step_loop_seconds = record.loop.seconds();
  settle(assembly, room);
  const double last = record.shape.back().stress;
  run.passed_peak = rig.has_fallen(so_far(record, plan)) || last < 0.95 * record.peak;
  for (std::size_t k = 0; k <= record.peak_index; ++k)
    if (record.shape[k].stress > 0.5 * record.peak)
      run.unbalanced_force_ratio = std::max(run.unbalanced_force_ratio, record.shape[k].unbalanced);
  run.energy_balance_error = record.worst_imbalance / std::max(std::abs(record.ledger.external), 1e-300);
  run.steps = record.steps;
  run.time_step = plan.step.time_step;
  run.critical_time_step = plan.critical_time_step;
  run.velocity = plan.velocity;
  run.damping = plan.step.damping.factor;
  run.links = assembly.links.count;
  run.broken_links = dem::broken_links(assembly.law, assembly.links);
  run.state_sha256 = dem::state_sha256(assembly);
  outcome.setting = rig.setting();
  outcome.measured = rig.measure(record.curve);
  outcome.curve = std::move(record.curve);
  outcome.fields = final_fields(assembly);
  record.film.take(assembly, plan.step.time_step * static_cast<double>(record.steps),
                   record.shape.back().strain, last);
  outcome.fields.film = std::move(record.film);
  if (rig.changed_specimen()) outcome.tested = rig.specimen();
  outcome.wall_seconds = record.wall.seconds();
  return outcome;
}

}  // namespace virtual_tests
