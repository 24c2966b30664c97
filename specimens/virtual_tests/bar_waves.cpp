#include "specimens/virtual_tests/bar_waves.h"

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"

namespace virtual_tests {

std::size_t BarSlices::at(double part_of_length) const {
  const auto k = static_cast<std::size_t>(part_of_length * static_cast<double>(count()));
  return std::min(k, count() - 1);
}

BarSlices cut_bar(const dem::Particles& particles, int axis, double length, double section, double thickness) {
  const auto count = static_cast<std::size_t>(length / thickness);
  BarSlices slices{axis, length, section, {}, std::vector<double>(count, 0), std::vector<double>(count, 0)};
  for (std::size_t i = 0; i < particles.count; ++i) {
    const double x = particles.initial_position[i][axis];
    const double place =
        std::clamp(x / length * static_cast<double>(count), 0.0, static_cast<double>(count - 1));
    const auto k = static_cast<std::size_t>(place);
    slices.of_element.push_back(static_cast<std::int32_t>(k));
    slices.mass[k] += particles.element_mass(i);
    slices.position[k] += particles.element_mass(i) * x;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (!(slices.mass[k] > 0))
      throw dem::InputError("specimen", "has a slice without elements", "make it with more elements");
    slices.position[k] /= slices.mass[k];
  }
  return slices;
}

void add_row(BarHistory& history, const BarSlices& slices, const dem::Particles& particles, double time) {
  std::vector<double> moved(slices.count(), 0), speed(slices.count(), 0);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const auto k = static_cast<std::size_t>(slices.of_element[i]);
    const double mass = particles.element_mass(i);
    moved[k] += mass * particles.displacement(i)[slices.axis];
    speed[k] += mass * particles.kinematics[i].rate(slices.axis);
  }
  history.time.push_back(time);
  for (std::size_t k = 0; k < slices.count(); ++k) {
    history.displacement.push_back(moved[k] / slices.mass[k]);
    history.velocity.push_back(speed[k] / slices.mass[k]);
  }
}

BarRecord::BarRecord(const BarSlices& bar, const BarHistory& seen) : slices(bar), history(seen) {}

double BarRecord::strain(std::size_t row, std::size_t slice) const {
  const std::size_t low = slice < 2 ? 0 : slice - 2, high = std::min(slice + 2, slices.count() - 1);
  return (displacement(row, high) - displacement(row, low)) / (slices.position[high] - slices.position[low]);
}

std::vector<double> BarRecord::stress_below(std::size_t slice, double window) const {
  std::vector<double> momentum(rows(), 0), stress(rows(), 0);
  for (std::size_t r = 0; r < rows(); ++r)
    for (std::size_t k = slice; k < slices.count(); ++k) momentum[r] += slices.mass[k] * velocity(r, k);
  if (rows() < 3) return stress;
  const double spacing = time(1) - time(0);
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(0.5 * window / spacing)));
  for (std::size_t r = half; r + half < rows(); ++r)
    stress[r] = -(momentum[r + half] - momentum[r - half]) / (time(r + half) - time(r - half)) / slices.section;
  return stress;
}

double BarRecord::crest_time(std::size_t slice, double until) const {
  const double half = 0.5 * highest_velocity(slice, until);
  double weight = 0, moment = 0;
  for (std::size_t r = 0; r < rows() && time(r) < until; ++r) {
    const double above = velocity(r, slice) - half;
    if (above > 0) weight += above, moment += above * time(r);
  }
  return weight > 0 ? moment / weight : 0;
}

double BarRecord::highest_velocity(std::size_t slice, double until) const {
  double highest = 0;
  for (std::size_t r = 0; r < rows() && time(r) < until; ++r) highest = std::max(highest, velocity(r, slice));
  return highest;
}

PullBack pull_back_of(const BarRecord& record, std::size_t free_slice, double peak_before) {
  PullBack found;
  std::size_t top = 0;
  for (std::size_t r = 0; r < record.rows() && record.time(r) < peak_before; ++r)
    if (record.velocity(r, free_slice) > found.peak) found.peak = record.velocity(r, free_slice), top = r;
  double lowest = found.peak;
  for (std::size_t r = top; r < record.rows(); ++r) {
    const double velocity = record.velocity(r, free_slice);
    lowest = std::min(lowest, velocity);
    if (velocity > lowest + 0.03 * found.peak) break;
  }
  found.drop = found.peak - lowest;
  return found;
}

std::vector<double> broken_part_below(const BarSlices& slices, const dem::LinkLaw& law,
                                      const dem::Links& links) {
  std::vector<double> broken(slices.count(), 0), all(slices.count(), 0);
  for (std::size_t k = 0; k < links.count; ++k) {
    const auto a = static_cast<std::size_t>(slices.of_element[static_cast<std::size_t>(links.a[k])]);
    const auto b = static_cast<std::size_t>(slices.of_element[static_cast<std::size_t>(links.b[k])]);
    for (std::size_t plane = std::min(a, b) + 1; plane <= std::max(a, b); ++plane) {
      all[plane] += 1;
      if (law.is_broken(links.max_strain[k])) broken[plane] += 1;
    }
  }
  for (std::size_t plane = 0; plane < broken.size(); ++plane)
    if (all[plane] > 0) broken[plane] /= all[plane];
  return broken;
}

double rise_time(const std::vector<double>& time, const std::vector<double>& value) {
  if (value.empty()) return 0;
  const auto top = static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
  const double peak = value[top];
  const auto crossing = [&](double level) {  // the last one before the maximum
    std::size_t k = top;
    while (k > 0 && value[k - 1] > level) --k;
    if (k == 0) return time[0];
    const double share = (level - value[k - 1]) / (value[k] - value[k - 1]);
    return time[k - 1] + share * (time[k] - time[k - 1]);
  };
  return (crossing(0.9 * peak) - crossing(0.1 * peak)) / 0.8;
}

}  // namespace virtual_tests
