#include "libdem/probe/energy.h"

#include <algorithm>

namespace dem {

PairEnergy pair_energy(const LinkLaw& law, const Particles& particles, const Links& links) {
  PairEnergy total;
  for (std::size_t k = 0; k < links.count; ++k) {
    const Kinematics& a = particles.kinematics[static_cast<std::size_t>(links.a[k])];
    const Kinematics& b = particles.kinematics[static_cast<std::size_t>(links.b[k])];
    const double distance = (b.position() - a.position()).norm();
    const double volume = links.area[k] / links.inverse_initial_distance[k];
    if (law.broken_link_contact == BrokenLinkContact::radii && law.is_broken(links.max_strain[k])) {
      const double touching = a.radius + b.radius, gap = distance / touching - 1;
      if (gap < 0) total.elastic += 0.5 * law.normal_modulus * gap * gap * links.area[k] * touching;
    } else {
      const double strain = distance * links.inverse_initial_distance[k] - 1;
      total.elastic += stored_normal_energy(law, strain, links.max_strain[k], volume);
    }
    const double shear = links.shear_x[k] * links.shear_x[k] + links.shear_y[k] * links.shear_y[k] +
                         links.shear_z[k] * links.shear_z[k];
    if (shear > 0)
      total.elastic +=
          0.5 * shear /
          (law.shear_ratio * law.normal_modulus * links.area[k] * links.inverse_initial_distance[k]);
    if (links.remembers_moments) {
      const double r = std::min(a.radius, b.radius);
      const double unit = law.normal_modulus * links.area[k] * links.inverse_initial_distance[k] * r * r;
      const double rolling = links.moment_x[k] * links.moment_x[k] + links.moment_y[k] * links.moment_y[k] +
                             links.moment_z[k] * links.moment_z[k];
      if (rolling > 0) total.elastic += 0.5 * rolling / (law.moment.rolling_stiffness * unit);
      if (links.twist[k] != 0)
        total.elastic += 0.5 * links.twist[k] * links.twist[k] / (law.moment.twisting_stiffness * unit);
    }
    if (links.max_strain[k] < born_broken)
      total.softening += softening_energy(law, links.max_strain[k], volume);
  }
  return total;
}

}  // namespace dem
