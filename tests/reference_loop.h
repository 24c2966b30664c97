// The step as one would first write it: one pair after the other on plain doubles, forces added to both
// elements as they come. The same law and kinematics as the lanes, so that the lanes can be checked against it,
// and the baseline of the speed comparison. Without damping, without threads, without contacts' search.
#pragma once
#include <cstddef>
#include <vector>

#include "libdem/law/cohesive_link.h"
#include "libdem/law/pair_kinematics.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace reference {

inline dem::PairElement<double> element(const dem::Kinematics& k) {
  return {k.x, k.y, k.z, k.radius, k.vx, k.vy, k.vz, k.wx, k.wy, k.wz, k.weight};
}

/// Evaluates pair k, updates its history, and hands (force, moment, kinematics) to `take`.
template <dem::LinkChoices choices, class Take>
void each_pair(const dem::LinkLaw& law, const dem::Particles& particles, dem::Links& links, double time_step,
               double& sliding, Take&& take) {
  for (std::size_t k = 0; k < links.count; ++k) {
    const auto i = static_cast<std::size_t>(links.a[k]), j = static_cast<std::size_t>(links.b[k]);
    const dem::PairElement<double> a = element(particles.kinematics[i]), b = element(particles.kinematics[j]);
    const dem::PairKinematics<double> pair = dem::pair_kinematics(a, b, time_step);
    dem::PairHistory<double> history{links.max_strain[k], links.shear_x[k], links.shear_y[k], links.shear_z[k],
                                     choices.moment_transfer ? links.slip[k] : 0.0};
    const auto slid = [&](double work) { sliding += work; };
    const double area = dem::interaction_area(a, b);
    const dem::PairForce<double> force = dem::evaluate<choices>(
        law, pair, links.inverse_initial_distance[k], area, a.radius + b.radius, time_step, history, slid);
    dem::PairMoment<double> moment{};
    if constexpr (choices.moment_transfer) {
      dem::MomentHistory<double> moments{links.moment_x[k], links.moment_y[k], links.moment_z[k],
                                         links.twist[k]};
      moment =
          dem::transfer_moment(law.moment, law.normal_modulus, a, b, pair, links.inverse_initial_distance[k],
                               area, force.normal, time_step, moments, slid);
      links.slip[k] = history.slip;
      links.moment_x[k] = moments.x, links.moment_y[k] = moments.y, links.moment_z[k] = moments.z;
      links.twist[k] = moments.twist;
    }
    links.max_strain[k] = history.max_strain;
    links.shear_x[k] = history.shear_x;
    links.shear_y[k] = history.shear_y;
    links.shear_z[k] = history.shear_z;
    take(k, i, j, force, moment, pair);
  }
}

/// Positions and rotations to the end of the step.
inline void move(dem::Particles& particles, double time_step) {
  for (std::size_t i = 0; i < particles.count; ++i) {
    dem::Kinematics& k = particles.kinematics[i];
    k.x += time_step * k.vx, k.y += time_step * k.vy, k.z += time_step * k.vz;
    particles.rotation[i] += time_step * k.spin();
  }
}

/// One step of the assembly's links: positions, forces, velocities (Eq. 9). Returns what sliding dissipated
/// [J].
template <dem::LinkChoices choices>
double step(const dem::LinkLaw& law, dem::Particles& particles, dem::Links& links, double time_step) {
  move(particles, time_step);
  for (dem::SixRow& force : particles.force) force = {};
  double sliding = 0;
  each_pair<choices>(law, particles, links, time_step, sliding,
                     [&](std::size_t, std::size_t i, std::size_t j, const dem::PairForce<double>& force,
                         const dem::PairMoment<double>& moment, const dem::PairKinematics<double>& pair) {
                       double* fa = particles.force[i].value;
                       double* fb = particles.force[j].value;
                       fa[0] += force.fx, fa[1] += force.fy, fa[2] += force.fz;
                       fb[0] -= force.fx, fb[1] -= force.fy, fb[2] -= force.fz;
                       fa[3] += pair.arm_a * force.mx, fb[3] += pair.arm_b * force.mx;
                       fa[4] += pair.arm_a * force.my, fb[4] += pair.arm_b * force.my;
                       fa[5] += pair.arm_a * force.mz, fb[5] += pair.arm_b * force.mz;
                       fa[3] += moment.x, fa[4] += moment.y, fa[5] += moment.z;
                       fb[3] -= moment.x, fb[4] -= moment.y, fb[5] -= moment.z;
                     });
  for (std::size_t i = 0; i < particles.count; ++i) {
    double* velocity = &particles.kinematics[i].vx;
    const dem::Inertia& inertia = particles.inertia[i];
    for (int c = 0; c < 6; ++c)
      if (!particles.is_prescribed(i, c))
        velocity[c] +=
            time_step * (c < 3 ? inertia.inverse_mass : inertia.inverse_moment) * particles.force[i].value[c];
  }
  return sliding;
}

}  // namespace reference
