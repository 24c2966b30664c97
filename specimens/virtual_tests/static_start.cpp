#include "specimens/virtual_tests/static_start.h"

#include "libdem/statics/static_solve.h"

namespace virtual_tests {

void start_as_elastic(dem::Particles& particles, const dem::LinkNetwork& network) {
  std::vector<std::uint8_t> held(6 * particles.count, 0);
  std::vector<double> motion(6 * particles.count, 0.0);
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int c = 0; c < 6; ++c)
      if (particles.is_prescribed(i, c)) {
        held[6 * i + static_cast<std::size_t>(c)] = 1;
        motion[6 * i + static_cast<std::size_t>(c)] = (&particles.kinematics[i].vx)[c];
      }
  const dem::StaticSolution solution = dem::solve_static(network, std::move(held), std::move(motion), 1e-7);
  for (std::size_t i = 0; i < particles.count; ++i)
    for (std::size_t c = 0; c < 6; ++c) {
      (&particles.kinematics[i].vx)[c] = solution.displacement[6 * i + c];
      particles.force[i].value[c] = -solution.force[6 * i + c];  // what the links exert on the element
    }
}

}  // namespace virtual_tests
