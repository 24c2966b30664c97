#include "libdem/run/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "libdem/core/error.h"

namespace dem {
namespace {

bool is_finite(const Kinematics& k) {
  return k.position().allFinite() && k.velocity().allFinite() && k.spin().allFinite();
}

/// An element that came into contact with `element` after the start; -1 if there is none.
std::int64_t in_contact_with(const Assembly& assembly, std::size_t element) {
  const auto me = static_cast<std::int32_t>(element);
  const Links& contacts = assembly.contacts;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.a[k] == me || contacts.b[k] == me) return contacts.a[k] == me ? contacts.b[k] : contacts.a[k];
  return -1;
}

[[noreturn]] void stop(const Assembly& assembly, std::size_t element, const std::string& what, long step,
                       std::string_view run) {
  const Vec3& x = assembly.particles.initial_position[element];
  const std::int64_t other = in_contact_with(assembly, element);
  const std::string cause =
      other >= 0
          ? fmt::format(
                "it came into contact with element {}, and contacts may be stiffer than the links that the "
                "time step was chosen for",
                other)
          : std::string("the time step is likely too long for the stiffest links");
  throw RunError(
      fmt::format("the {} diverged at step {}: element {}, at ({:.4g}, {:.4g}, {:.4g}) m at the start, {}; {}: "
                  "lower the time step fraction",
                  run, step, element, x.x(), x.y(), x.z(), what, cause));
}

}  // namespace

void watch_motion(const Assembly& assembly, const StepRoom& room, const StepSums& sums, double time_step,
                  long step, std::string_view run) {
  const Particles& particles = assembly.particles;
  // One element that is no number makes the sum none; the fastest one bounds how far any has moved.
  const bool numbers = std::isfinite(sums.kinetic) && std::isfinite(room.max_speed);
  if (numbers && room.max_speed * time_step < room.smallest_radius) return;
  for (std::size_t i = 0; i < particles.count; ++i)
    if (!is_finite(particles.kinematics[i])) stop(assembly, i, "moves by what is no number", step, run);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double way = particles.kinematics[i].velocity().norm() * time_step;
    if (!(way < particles.radius[i]))
      stop(assembly, i, fmt::format("moves by {:.3g} m in one step, more than its radius", way), step, run);
  }
  if (!numbers)
    throw RunError(fmt::format("the {} diverged at step {}: its kinetic energy is no number", run, step));
}

void watch_energy(const EnergyLedger& ledger, long step, std::string_view run) {
  const double passed = std::abs(ledger.external) + ledger.initial + ledger.kinetic + ledger.elastic +
                        ledger.softening + std::abs(ledger.sliding) + std::abs(ledger.damping);
  if (ledger.imbalance() >= -allowed_energy_growth * passed) return;  // NaN does not pass either
  throw RunError(fmt::format(
      "the {} was stopped at step {}: energy grew by {:.1f}% without cause (allowed: {:.0f}%); lower "
      "the time step fraction",
      run, step, -100 * ledger.imbalance() / passed, 100 * allowed_energy_growth));
}

}  // namespace dem
