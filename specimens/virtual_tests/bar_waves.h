// What a wave does in a bar, seen slice by slice: histories, and what a spalling test reads from them.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace virtual_tests {

/// A bar cut across its axis into slices of one thickness. Slice 0 is at the low end.
struct BarSlices {
  int axis = 0;
  double length = 0, section = 0;        ///< [m], [m2]
  std::vector<std::int32_t> of_element;  ///< element -> slice
  std::vector<double> mass;              ///< [kg]
  std::vector<double> position;          ///< of the centre of mass at rest [m]

  std::size_t count() const { return mass.size(); }
  std::size_t at(double part_of_length) const;
};

/// Slices about `thickness` thick. Throws InputError if one is empty.
BarSlices cut_bar(const dem::Particles& particles, int axis, double length, double section, double thickness);

/// Mean displacement and velocity along the axis of every slice, over time.
struct BarHistory {
  std::vector<double> time;          ///< [s]
  std::vector<double> displacement;  ///< slice by slice, time by time [m]
  std::vector<double> velocity;      ///< the same [m/s]
};

/// Adds a row; `time` is that of the positions, velocities are half a step later.
void add_row(BarHistory& history, const BarSlices& slices, const dem::Particles& particles, double time);

/// The histories of one bar, ready to be asked.
class BarRecord {
 public:
  BarRecord(const BarSlices& slices, const BarHistory& history);

  std::size_t rows() const { return history.time.size(); }
  double time(std::size_t row) const { return history.time[row]; }
  double displacement(std::size_t row, std::size_t slice) const {
    return history.displacement[row * slices.count() + slice];
  }
  double velocity(std::size_t row, std::size_t slice) const {
    return history.velocity[row * slices.count() + slice];
  }
  /// Strain between two slices either side of `slice`, extension positive [-].
  double strain(std::size_t row, std::size_t slice) const;
  /// Mean stress across the plane below `slice` over time, tension positive [Pa]: the rate of the momentum of
  /// all that lies beyond, whose far end is free. Differences over about `window` [s].
  std::vector<double> stress_below(std::size_t slice, double window) const;
  /// The mean time of the upper half of the velocity's crest at a slice, before `until` [s].
  double crest_time(std::size_t slice, double until) const;
  /// The highest velocity at a slice before `until` [m/s].
  double highest_velocity(std::size_t slice, double until) const;

 private:
  const BarSlices& slices;
  const BarHistory& history;
};

/// What the free end's velocity tells.
struct PullBack {
  double peak = 0;  ///< [m/s]
  double drop = 0;  ///< to the first minimum after it, from which it rises by 3% of the peak [m/s]
};
PullBack pull_back_of(const BarRecord& record, std::size_t free_slice, double peak_before);

/// Broken links over all links that cross the plane below each slice; 0 for slice 0.
std::vector<double> broken_part_below(const BarSlices& slices, const dem::LinkLaw& law,
                                      const dem::Links& links);

/// The time that a curve's rise to its maximum takes from a tenth to nine tenths of it, over eight tenths [s].
double rise_time(const std::vector<double>& time, const std::vector<double>& value);

}  // namespace virtual_tests
