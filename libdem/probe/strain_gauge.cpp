#include "libdem/probe/strain_gauge.h"

namespace dem {

StrainGauge::StrainGauge(std::span<const Vec3> initial_positions, std::vector<std::int32_t> wanted)
    : members(std::move(wanted)) {
  Vec3 mean = Vec3::Zero();
  for (const std::int32_t i : members) mean += initial_positions[static_cast<std::size_t>(i)];
  mean /= static_cast<double>(members.size());
  for (const std::int32_t i : members) {
    offset.emplace_back(initial_positions[static_cast<std::size_t>(i)] - mean);
    spread += offset.back().cwiseProduct(offset.back());
  }
}

template <class Displacement>
AxialStrains StrainGauge::slopes(Displacement&& displacement) const {
  Vec3 total = Vec3::Zero();  // the offsets sum to zero, so the mean displacement drops out
  for (std::size_t k = 0; k < members.size(); ++k)
    total += offset[k].cwiseProduct(displacement(static_cast<std::size_t>(members[k])));
  return {total.x() / spread.x(), total.y() / spread.y(), total.z() / spread.z()};
}

AxialStrains StrainGauge::measure(const Particles& particles) const {
  return slopes([&](std::size_t i) { return particles.displacement(i); });
}

AxialStrains StrainGauge::measure(std::span<const double> u) const {
  return slopes([&](std::size_t i) { return Vec3(u[6 * i], u[6 * i + 1], u[6 * i + 2]); });
}

}  // namespace dem
