#include "impact/coupling/discrete_side.h"

namespace coupling {

void weigh(const Zone& zone, dem::Particles& particles, dem::Links& links) {
  const std::vector<double> weights = discrete_weights(zone, particles.initial_position);
  for (std::size_t i = 0; i < particles.count; ++i) particles.set_weight(i, weights[i]);
  weigh_links(weights, {links.a.data(), links.count}, {links.b.data(), links.count},
              {links.area.data(), links.count});
}

DiscreteMasses tied_masses(const KinematicMap& map, const dem::Particles& particles) {
  DiscreteMasses masses;
  masses.row.reserve(map.elements.size());
  for (const std::int32_t number : map.elements) {
    const auto i = static_cast<std::size_t>(number);
    std::array<double, 6> row{};
    for (std::size_t dof = 0; dof < 6; ++dof)
      if (!particles.is_prescribed(i, static_cast<int>(dof)))
        row[dof] = dof < 3 ? particles.element_mass(i) : particles.element_inertia(i);
    masses.row.push_back(row);
  }
  return masses;
}

DiscreteVelocities velocities(dem::Particles& particles) {
  return {&particles.kinematics.front().vx, sizeof(dem::Kinematics) / sizeof(double)};
}

}  // namespace coupling
