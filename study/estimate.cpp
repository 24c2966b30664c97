#include "study/estimate.h"

#include <algorithm>
#include <cmath>

namespace study {
namespace {

// Rates of one core of an AMD EPYC (Zen 5, AVX-512), rounded: what docs/studies.md says of them comes from
// here.
constexpr double seconds_per_element_step = 6e-8;  // links, contacts and bookkeeping
constexpr double seconds_per_packed_element = 3e-5;
constexpr double seconds_per_solved_element = 2e-6;  // times the elements along the specimen: iterations
constexpr double bytes_per_element = 2000;           // 1300 measured, with curve and fields
constexpr double bytes_per_task = 25e6;
/// The critical time step over (element size / wave speed), and the part of it that a test takes.
constexpr double critical_share = 0.56;

specimens::Specimen nominal(const specimens::PackingOptions& packing) {
  specimens::Specimen specimen;
  specimen.shape = packing.shape;
  specimen.size = packing.size;
  return specimen;
}

double memory(const specimens::PackingOptions& specimen) {
  return bytes_per_task + bytes_per_element * static_cast<double>(specimen.elements);
}

}  // namespace

Estimate estimate_test(const specimens::PackingOptions& packing, const dem::MaterialCard& card,
                       const VirtualTest& test) {
  const specimens::Specimen specimen = nominal(packing);
  const auto elements = static_cast<double>(packing.elements);
  const double element_size = std::cbrt(specimen.volume() / elements);
  const double longest = specimen.size.maxCoeff();
  if (test.kind == TestKind::elastic)
    return {seconds_per_solved_element * elements * longest / element_size, memory(packing)};
  if (!std::holds_alternative<virtual_tests::UniaxialOptions>(test.options)) {
    // See specimens/virtual_tests/rig_run: the elastic peak is reached after length / (wave speed * rate).
    const virtual_tests::TestDescription& description = virtual_tests::description_of(test.options);
    const double asked = std::visit(
        [](const auto& o) -> double {
          if constexpr (requires { o.run.rate; })
            return o.run.rate;
          else
            return 0;
        },
        test.options);
    // A wave runs through a bar usual_end times.
    if (description.dynamic)
      return {seconds_per_element_step * elements * description.usual_end * longest /
                  (0.7 * critical_share * element_size),
              memory(packing)};
    const double rate = asked > 0 ? asked : description.usual_rate;
    const double steps = description.usual_end * longest / (rate * 0.7 * critical_share * element_size);
    return {seconds_per_element_step * elements * steps, memory(packing)};
  }

  // The numbers that a uniaxial test settles before its first step: see specimens/virtual_tests/uniaxial_plan.
  const bool tension = test.kind == TestKind::tension;
  const auto& o = std::get<virtual_tests::UniaxialOptions>(test.options);
  const int axis = o.axis < 0 ? specimen.long_axis() : o.axis;
  const double strength =
      o.expected_strength > 0 ? o.expected_strength : (tension ? 0.9 : 6) * card.tensile_strength;
  const double elastic_strain = strength / card.young_modulus;
  const double wave_speed = std::sqrt(card.young_modulus / card.density);
  const double rate = o.rate > 0 ? o.rate : tension ? 0.03 : 0.01;
  const double velocity = o.velocity > 0 ? o.velocity : rate * wave_speed * elastic_strain;
  const double limit = o.max_strain > 0 ? o.max_strain : elastic_strain * (tension ? 20 : 8);
  const double end = std::min(limit, elastic_strain * (tension ? 1 + card.softening / 3 : 1.5));
  const double time_step = o.time_step_fraction * critical_share * element_size / wave_speed;
  const double steps = end * specimen.size[axis] / (velocity * time_step);
  return {seconds_per_element_step * elements * steps, memory(packing)};
}

Estimate estimate_packing(const specimens::PackingOptions& packing) {
  return {seconds_per_packed_element * static_cast<double>(packing.elements), memory(packing)};
}

}  // namespace study
