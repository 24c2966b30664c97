#include "specimens/virtual_tests/rig.h"

#include <fmt/format.h>

#include <algorithm>

#include "libdem/core/error.h"

namespace virtual_tests {

void QuasiStaticOptions::validate() const {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw dem::InputError(key, fmt::format("{} is out of range", value), fmt::format("allowed: {}", allowed));
  };
  if (!(damping >= 0 && damping < 1)) refuse("damping", damping, "0 to below 1");
  if (!(time_step_fraction > 0 && time_step_fraction < 1))
    refuse("time step fraction", time_step_fraction, "above 0, below 1 (the critical time step)");
  if (!(velocity >= 0)) refuse("velocity", velocity, "positive");
  if (!(rate >= 0)) refuse("rate", rate, "positive");
  if (!(stop_at >= 0 && stop_at < 1)) refuse("stop-at", stop_at, "above 0, below 1 (part of the peak stress)");
  if (!(max_control >= 0)) refuse("largest displacement", max_control, "positive");
  if (!(expected_strength >= 0)) refuse("expected strength", expected_strength, "positive");
  if (threads < 1) refuse("threads", threads, "1 or more");
}

bool Rig::has_fallen(const SoFar& so_far) const {
  return so_far.stress < so_far.stop_at * so_far.peak_stress && so_far.control > 1.02 * so_far.peak_control &&
         so_far.peak_stress > facts().least_peak;
}

bool Rig::is_over(const SoFar& so_far) const { return has_fallen(so_far) || so_far.control >= so_far.furthest; }

double force_along(const dem::Particles& particles, std::span<const std::int32_t> elements,
                   const dem::Vec3& direction) {
  double total = 0;
  for (const std::int32_t i : elements) {
    const double* force = particles.force[static_cast<std::size_t>(i)].value;
    total += force[0] * direction.x() + force[1] * direction.y() + force[2] * direction.z();
  }
  return total;
}

double displacement_along(const dem::Particles& particles, std::span<const std::int32_t> elements,
                          const dem::Vec3& direction) {
  double total = 0;
  for (const std::int32_t i : elements)
    total += particles.displacement(static_cast<std::size_t>(i)).dot(direction);
  return elements.empty() ? 0 : total / static_cast<double>(elements.size());
}

std::size_t row_of_peak(const CurveTable& curve, std::string_view column) {
  const std::vector<double> values = curve.column(column);
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double peak_in(const CurveTable& curve, std::string_view column) {
  const std::vector<double> values = curve.column(column);
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace virtual_tests
