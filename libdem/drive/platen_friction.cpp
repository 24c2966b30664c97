#include "libdem/drive/platen_friction.h"

#include <algorithm>

namespace dem {

PlatenFriction::PlatenFriction(const Particles& particles, const Platens& platens, double wanted,
                               double stiffness_over_radius)
    : axis(platens.axis), coefficient(wanted) {
  // The force that a layer's element feels along the axis is what it passes on to the platen.
  for (const auto& [layer, sign] : {std::pair(&platens.low, -1.0), std::pair(&platens.high, 1.0)})
    for (const std::int32_t i : *layer) {
      const auto at = static_cast<std::size_t>(i);
      const Vec3 place = particles.kinematics[at].position();
      holds.push_back({i, sign, stiffness_over_radius * particles.radius[at], place, place, Vec3::Zero(), 0});
    }
  std::sort(holds.begin(), holds.end(), [](const Hold& a, const Hold& b) { return a.element < b.element; });
  for (const Hold& hold : holds) loads.push_back({hold.element, Vec3::Zero(), Vec3::Zero()});
}

void PlatenFriction::feel(const Particles& particles) {
  for (Hold& hold : holds)
    hold.push = hold.sign * particles.force[static_cast<std::size_t>(hold.element)].value[axis];
}

const std::vector<ElementLoad>& PlatenFriction::grip(const Particles& particles) {
  for (std::size_t k = 0; k < holds.size(); ++k) {
    Hold& hold = holds[k];
    const auto i = static_cast<std::size_t>(hold.element);
    const Vec3 place = particles.kinematics[i].position();
    Vec3 stretch = place - hold.anchor;
    stretch[axis] = 0;
    const double limit = coefficient * std::max(0.0, hold.push) / hold.stiffness;
    if (const double length = stretch.norm(); length > limit) {
      const Vec3 kept = limit / length * stretch;
      hold.anchor += stretch - kept;
      stretch = kept;
    }
    const Vec3 force = -hold.stiffness * stretch;
    done += 0.5 * (hold.force + force).dot(place - hold.position);
    hold.force = force;
    hold.position = place;
    loads[k].force = force;
  }
  return loads;
}

std::vector<double> PlatenFriction::memory() const {
  std::vector<double> numbers{done};
  for (const Hold& hold : holds) {
    for (const Vec3& v : {hold.anchor, hold.position, hold.force})
      numbers.insert(numbers.end(), v.begin(), v.end());
    numbers.push_back(hold.push);
  }
  return numbers;
}

void PlatenFriction::restore(const std::vector<double>& memory) {
  if (memory.size() != 1 + 10 * holds.size()) return;
  done = memory[0];
  for (std::size_t k = 0; k < holds.size(); ++k) {
    const double* v = memory.data() + 1 + 10 * k;
    holds[k].anchor = Vec3(v[0], v[1], v[2]);
    holds[k].position = Vec3(v[3], v[4], v[5]);
    holds[k].force = Vec3(v[6], v[7], v[8]);
    holds[k].push = v[9];
  }
}

}  // namespace dem
