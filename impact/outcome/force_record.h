// The contact force of an impact: peak, impulse, duration.
#pragma once
#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "libdem/core/vector.h"

namespace impact {

using dem::Vec3;

/// Takes the force of every step as the run goes on. The impulse is the sum of force times step, which is what
/// a leapfrog has given the body, to rounding.
class ForceRecord {
 public:
  /// `window` [s]: peaks are also taken of the mean over so long, since single steps ring with the elements'
  /// contacts; 0 for none.
  explicit ForceRecord(double window = 0);

  /// `time` at the end of the step [s], later than before; the force at that time [N].
  void add(double time, double time_step, const Vec3& force);

  /// Everything that a checkpoint must keep, and back, bit for bit. Throws InputError that names `where` if the
  /// numbers are no record.
  std::vector<double> to_numbers() const;
  static ForceRecord from_numbers(std::span<const double> numbers, const std::string& where);

  double peak_force() const { return peak; }            ///< largest norm [N]
  double time_of_peak() const { return peak_time; }     ///< [s]
  double peak_mean_force() const { return peak_mean; }  ///< largest norm of the mean over a whole window [N]
  const Vec3& impulse() const { return total; }         ///< [N s]
  double first_contact() const { return first; }  ///< time of the first force that is not zero; NaN if none [s]
  double last_contact() const { return last; }    ///< the same of the last [s]

 private:
  struct Sample {
    double time_step;
    Vec3 impulse;
  };
  double window, peak = 0, peak_time, peak_mean = 0, first, last, covered = 0;
  Vec3 total = Vec3::Zero();
  std::deque<Sample> recent;
};

/// The same from a stored history of equal steps. Throws InputError if the columns differ in length or time
/// does not increase.
ForceRecord reduce(std::span<const double> time, std::span<const Vec3> force, double window = 0);

}  // namespace impact
