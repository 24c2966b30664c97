#include "specimens/virtual_tests/uniaxial_plan.h"

#include <algorithm>
#include <cmath>

#include "libdem/motion/critical_step.h"
#include "specimens/virtual_tests/setup.h"

namespace virtual_tests {
namespace {

/// Where tests of ordinary cards ended, in elastic strains: tension the later the more slowly its links soften.
double likely_end(Loading loading, const dem::MaterialCard& card, double elastic_strain) {
  return elastic_strain * (loading == Loading::tension ? 1 + card.softening / 3 : 1.5);
}

}  // namespace

UniaxialPlan make_plan(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                       const UniaxialOptions& options, const dem::Assembly& assembly) {
  const bool tension = options.loading == Loading::tension;
  const int axis = loading_axis(specimen, options.axis);
  const double expected_strength = options.expected_strength > 0 ? options.expected_strength
                                   : tension                     ? 0.9 * card.tensile_strength
                                                                 : 6 * card.tensile_strength;
  const double elastic_strain = expected_strength / card.young_modulus;
  const double wave_speed = std::sqrt(card.young_modulus / card.density);
  const double rate = options.rate > 0 ? options.rate : tension ? 0.03 : 0.01;
  const double velocity = options.velocity > 0 ? options.velocity : rate * wave_speed * elastic_strain;
  const double max_strain = options.max_strain > 0 ? options.max_strain : elastic_strain * (tension ? 20 : 8);

  dem::Platens platens =
      dem::find_platens(assembly.particles, axis, specimen.size[axis], specimen.element_size());
  const double strain_rate = velocity / platens.gauge_length;
  const double critical = dem::critical_time_step(link_network(specimen, assembly), assembly.particles);
  const double time_step = options.time_step_fraction * critical;
  // Damping acts fully on velocities above a thousandth of the platens': below that they are rounding, not
  // motion.
  const double slow = 1e-3 * velocity;
  const long half_window = std::max(1L, std::lround(elastic_strain / 120 / (strain_rate * time_step)) / 2);

  return {.loading = options.loading,
          .axis = axis,
          .sign = tension ? -1.0 : 1.0,
          .expected_strength = expected_strength,
          .likely_end = std::min(max_strain, likely_end(options.loading, card, elastic_strain)),
          .velocity = velocity,
          .stop_at = options.stop_at > 0 ? options.stop_at
                     : tension           ? 0.15
                                         : 0.6,
          .least_peak = 0.2 * card.tensile_strength,
          .max_strain = max_strain,
          .section = specimen.section(axis),
          .strain_rate = strain_rate,
          .critical_time_step = critical,
          .step = {time_step, {options.damping, slow, slow / (0.5 * specimen.element_size())}, options.threads},
          .half_window = std::min(half_window, 500L),
          .platens = std::move(platens),
          .gauge = dem::StrainGauge(specimen.centres, gauge_elements(specimen, axis))};
}

}  // namespace virtual_tests
