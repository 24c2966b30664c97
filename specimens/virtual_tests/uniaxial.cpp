#include "specimens/virtual_tests/uniaxial.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/motion/critical_step.h"
#include "libdem/probe/damage.h"
#include "libdem/probe/strain_gauge.h"
#include "libdem/run/step.h"
#include "libdem/statics/link_network.h"
#include "specimens/virtual_tests/setup.h"

namespace virtual_tests {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What the options leave to the test, settled for one specimen and card.
struct Plan {
  double expected_strength, velocity, stop_at, max_strain, sign;
  int axis;
};

Plan plan(const specimens::Specimen& specimen, const dem::MaterialCard& card, const UniaxialOptions& options) {
  const bool tension = options.loading == Loading::tension;
  Plan p{};
  p.axis = loading_axis(specimen, options.axis);
  p.sign = tension ? -1 : 1;  // of the platens' closing speed
  p.expected_strength = options.expected_strength > 0 ? options.expected_strength
                        : tension                     ? 0.9 * card.tensile_strength
                                                      : 6 * card.tensile_strength;
  const double elastic_strain = p.expected_strength / card.young_modulus;
  const double wave_speed = std::sqrt(card.young_modulus / card.density);
  const double rate = options.rate > 0 ? options.rate : tension ? 0.03 : 0.01;
  p.velocity = options.velocity > 0 ? options.velocity : rate * wave_speed * elastic_strain;
  p.stop_at = options.stop_at > 0 ? options.stop_at : tension ? 0.15 : 0.6;
  p.max_strain = options.max_strain > 0 ? options.max_strain : elastic_strain * (tension ? 20 : 8);
  return p;
}

/// Sums over one window of steps.
struct Window {
  double low = 0, high = 0;
  long steps = 0;
};

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
  if (threads < 1) refuse("threads", threads, "1 or more");
}

UniaxialResult run_uniaxial(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                            const UniaxialOptions& options, const dem::ProgressCallback& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  dem::Assembly assembly = make_assembly(specimen, card);
  const Plan p = plan(specimen, card, options);
  const dem::LinkLaw& law = assembly.law;
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, law.normal_modulus,
                                 law.shear_ratio);

  UniaxialResult result;
  result.critical_time_step = dem::critical_time_step(network, assembly.particles);
  const double dt = options.time_step_fraction * result.critical_time_step;
  result.time_step = dt;
  result.velocity = p.velocity;
  result.links = assembly.links.count;

  const dem::Platens platens =
      dem::find_platens(assembly.particles, p.axis, specimen.size[p.axis], specimen.element_size());
  dem::drive(assembly.particles, platens, options.ends, p.sign * p.velocity);
  const dem::StrainGauge gauge(specimen.centres, gauge_elements(specimen, p.axis));
  const double section = specimen.section(p.axis), strain_rate = p.velocity / platens.gauge_length;

  dem::StepRoom room(assembly);
  // Damping acts fully on velocities above a thousandth of the platens': below that they are rounding, not
  // motion.
  const double slow = 1e-3 * p.velocity;
  const dem::StepOptions step{
      dt, {options.damping, slow, slow / (0.5 * specimen.element_size())}, options.threads};
  const double elastic_strain = p.expected_strength / card.young_modulus;
  long half_window = std::max(1L, std::lround(elastic_strain / 120 / (strain_rate * dt)) / 2);
  half_window = std::min(half_window, 500L);
  const long window_steps = 2 * half_window + 1;

  dem::EnergyLedger ledger;
  for (std::size_t i = 0; i < assembly.particles.count; ++i)
    ledger.initial +=
        0.5 * assembly.particles.element_mass(i) * assembly.particles.kinematics[i].velocity().squaredNorm();

  Window window;
  CurvePoint point;
  double peak = 0, worst_imbalance = 0, previous_reaction = 0;
  std::size_t peak_index = 0;
  const auto loop_start = std::chrono::steady_clock::now();
  for (result.steps = 1;; ++result.steps) {
    const dem::StepSums sums = dem::advance(assembly, room, step);
    ledger.sliding += sums.sliding;
    ledger.damping += sums.damped;
    ledger.kinetic = sums.kinetic;
    const double low = platens.low_reaction(assembly.particles),
                 high = platens.high_reaction(assembly.particles);
    // The platens close at half the speed each; their work is the mean reaction over the step times the way.
    const double reaction = p.sign * 0.5 * (low + high);
    ledger.external += 0.5 * (reaction + previous_reaction) * p.velocity * dt;
    previous_reaction = reaction;
    window.low += p.sign * low, window.high += p.sign * high, ++window.steps;

    if (window.steps == half_window + 1) {  // the middle of the window
      const dem::AxialStrains strain = gauge.measure(assembly.particles);
      const auto a = static_cast<std::size_t>(p.axis);
      point.strain = strain_rate * dt * static_cast<double>(result.steps);
      point.strain_axial = -p.sign * strain[a];
      point.strain_lateral = -p.sign * 0.5 * (strain[(a + 1) % 3] + strain[(a + 2) % 3]);
    }
    if (window.steps < window_steps) continue;

    const double n = static_cast<double>(window_steps) * section;
    point.stress = 0.5 * (window.low + window.high) / n;
    point.unbalanced = std::abs(window.low - window.high) /
                       std::max(std::abs(window.low + window.high) / 2, 1e-3 * p.expected_strength * n);
    window = {};
    if (!std::isfinite(point.stress) || !std::isfinite(point.strain_axial))
      throw dem::RunError(
          fmt::format("the {} test diverged at step {}: the stress is no number; lower the time step fraction",
                      name_of(options.loading), result.steps));
    const std::size_t windows = result.curve.size();
    if (windows % 4 == 0) {
      const dem::PairEnergy links = dem::pair_energy(law, assembly.particles, assembly.links);
      const dem::PairEnergy contacts = dem::pair_energy(law, assembly.particles, assembly.contacts);
      ledger.elastic = links.elastic + contacts.elastic;
      ledger.softening = links.softening;
      worst_imbalance = std::max(worst_imbalance, std::abs(ledger.imbalance()));
      point.broken =
          static_cast<double>(dem::broken_links(law, assembly.links)) / static_cast<double>(result.links);
    }
    result.curve.push_back(point);
    if (point.stress > peak) peak = point.stress, peak_index = windows;

    if (progress && windows % 8 == 0)
      progress({std::string(name_of(options.loading)), static_cast<double>(result.steps),
                p.max_strain / (strain_rate * dt), "steps",
                fmt::format("{:.2f} MPa at {:.3f} permil", point.stress / 1e6, point.strain * 1e3)});
    if (dem::interrupt_requested()) throw dem::Interrupted("stopped by a signal");

    const bool fallen = point.stress < p.stop_at * peak &&
                        point.strain > 1.02 * result.curve[peak_index].strain &&
                        peak > 0.2 * card.tensile_strength;
    if (fallen) result.passed_peak = true;
    if (fallen || point.strain >= p.max_strain) break;
  }
  result.step_loop_seconds = seconds_since(loop_start);

  const dem::PairEnergy links = dem::pair_energy(law, assembly.particles, assembly.links);
  ledger.softening = links.softening;
  ledger.elastic = links.elastic + dem::pair_energy(law, assembly.particles, assembly.contacts).elastic;
  result.energy = ledger;
  result.energy_balance_error = worst_imbalance / std::max(std::abs(ledger.external), 1e-300);
  result.peak_stress = peak;
  result.peak_strain = result.curve[peak_index].strain;
  result.passed_peak = result.passed_peak || peak < 0.95 * result.curve.back().stress ||
                       result.curve.back().stress < 0.95 * peak;
  for (std::size_t k = 0; k <= peak_index; ++k)
    if (result.curve[k].stress > 0.5 * peak)
      result.unbalanced_force_ratio = std::max(result.unbalanced_force_ratio, result.curve[k].unbalanced);
  const Moduli moduli = moduli_of(result.curve);
  result.young_modulus = moduli.young_modulus;
  result.poisson_ratio = moduli.poisson_ratio;
  result.work_of_fracture = work_of_fracture(result.curve, platens.gauge_length, moduli.young_modulus);
  result.broken_links = dem::broken_links(law, assembly.links);
  result.contacts = assembly.contacts.count;
  result.damage = dem::element_damage(law, assembly.links, assembly.particles.count);
  result.detector_rebuilds = room.detector.rebuilds();
  result.state_sha256 = dem::state_sha256(assembly);
  result.wall_seconds = seconds_since(start);
  return result;
}

}  // namespace virtual_tests
