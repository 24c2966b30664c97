#include "specimens/virtual_tests/uniaxial.h"

#include <fmt/format.h>

#include <numbers>

#include "libdem/core/error.h"
#include "libdem/run/step.h"
#include "libdem/run/watch.h"
#include "specimens/virtual_tests/expected_end.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/uniaxial_checkpoint.h"
#include "specimens/virtual_tests/uniaxial_plan.h"
#include "specimens/virtual_tests/uniaxial_record.h"

namespace virtual_tests {
namespace {

double kinetic_energy(const dem::Particles& particles) {
  double energy = 0;
  for (std::size_t i = 0; i < particles.count; ++i)
    energy += 0.5 * particles.element_mass(i) * particles.kinematics[i].velocity().squaredNorm();
  return energy;
}

dem::Progress where_it_stands(const UniaxialRecord& record, const UniaxialPlan& plan, bool over) {
  const CurvePoint& last = record.curve.back();
  const double end =
      expected_end(record.curve, record.peak_index, plan.likely_end, plan.stop_at, plan.max_strain);
  const auto done = static_cast<double>(record.steps);
  // A point lies in the middle of its window: at least the half window to its end is still to come.
  const double total = end / plan.strain_after(1) + static_cast<double>(plan.half_window);
  return {std::string(name_of(plan.loading)), done, over ? done : std::max(total, done + 1), "steps",
          fmt::format("{:.2f} MPa at {:.3f} permil", last.stress / 1e6, last.strain * 1e3)};
}

}  // namespace

std::string_view name_of(Loading loading) { return loading == Loading::tension ? "tension" : "compression"; }

void UniaxialOptions::validate() const {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw dem::InputError(key, fmt::format("{} is out of range", value), fmt::format("allowed: {}", allowed));
  };
  if (!(damping >= 0 && damping < 1)) refuse("damping", damping, "0 to below 1");
  if (!(time_step_fraction > 0 && time_step_fraction < 1))
    refuse("time step fraction", time_step_fraction, "above 0, below 1 (the critical time step)");
  if (!(velocity >= 0)) refuse("velocity", velocity, "positive");
  if (!(rate >= 0)) refuse("rate", rate, "positive");
  if (!(stop_at >= 0 && stop_at < 1)) refuse("stop-at", stop_at, "above 0, below 1 (part of the peak stress)");
  if (!(max_strain >= 0 && max_strain < 0.5)) refuse("max-strain", max_strain, "above 0, below 0.5");
  if (!(expected_strength >= 0)) refuse("expected strength", expected_strength, "positive");
  if (!(platen_friction >= 0 && platen_friction <= 2)) refuse("platen friction", platen_friction, "0 to 2");
  if (ends == dem::EndCondition::rough && loading == Loading::tension)
    throw dem::InputError("ends", "rough platens cannot pull", "allowed in tension: free, fixed");
  if (threads < 1) refuse("threads", threads, "1 or more");
}

UniaxialResult run_uniaxial(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                            const UniaxialOptions& options, const dem::ProgressCallback& progress,
                            const CheckpointPolicy& checkpoint) {
  UniaxialRecord record;
  record.film = Film(checkpoint.pictures);
  options.validate();
  dem::Assembly assembly = make_assembly(specimen, card);
  const UniaxialPlan plan = make_plan(specimen, card, options, assembly);
  dem::drive(assembly.particles, plan.platens, options.ends, plan.sign * plan.velocity);
  record.ledger.initial = kinetic_energy(assembly.particles);

  dem::StepRoom room(assembly);
  if (options.ends == dem::EndCondition::rough)
    record.friction =
        dem::PlatenFriction(assembly.particles, plan.platens, options.platen_friction,
                            assembly.law.shear_ratio * assembly.law.normal_modulus * std::numbers::pi / 2);
  CheckpointKeeper keeper(checkpoint, belonging_of(checkpoint, specimen, card, options));
  if (const auto numbers = keeper.restore(assembly, room)) set_from(record, *numbers, checkpoint.file);
  const auto kept = [&] { return numbers_of(record, room.detector.rebuilds()); };

  const std::string test = fmt::format("{} test", name_of(options.loading));
  record.loop.start = std::chrono::steady_clock::now();
  for (bool over = false; !over;) {
    const dem::StepSums sums =
        dem::advance(assembly, room, plan.step, record.friction.grip(assembly.particles));
    book_step(record, plan, sums, assembly.particles);
    dem::watch_motion(assembly, room, sums, plan.step.time_step, record.steps, test);
    if (window_is_full(record, plan)) {
      close_window(record, plan, assembly, room);
      over = is_over(record, plan);
      if (progress) progress(where_it_stands(record, plan, over));
    }
    if (!over) keeper.look(assembly, room, record.steps, kept);
  }
  return conclude(std::move(record), plan, assembly, room);
}

}  // namespace virtual_tests
