#include "impact/outcome/force_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/error.h"

namespace impact {

ForceRecord::ForceRecord(double mean_over)
    : window(mean_over),
      peak_time(std::numeric_limits<double>::quiet_NaN()),
      first(std::numeric_limits<double>::quiet_NaN()),
      last(std::numeric_limits<double>::quiet_NaN()) {
  if (!(window >= 0 && std::isfinite(window)))
    throw dem::InputError("contact force", fmt::format("the window is {} s", window), "it must be 0 or more");
}

void ForceRecord::add(double time, double time_step, const Vec3& force) {
  const double size = force.norm();
  total += time_step * force;
  if (size > peak) peak = size, peak_time = time;
  if (size > 0) {
    if (std::isnan(first)) first = time;
    last = time;
  }
  if (window == 0) return;
  recent.push_back({time_step, time_step * force});
  covered += time_step;
  // Half a step of slack, or rounding would decide how many steps a window has.
  while (recent.size() > 1 && covered - recent.front().time_step > window - 0.5 * time_step) {
    covered -= recent.front().time_step;
    recent.pop_front();
  }
  if (covered < window - 0.5 * time_step) return;
  Vec3 sum = Vec3::Zero();
  for (const Sample& sample : recent)
    sum += sample.impulse;  // anew each time: differences would gather rounding
  peak_mean = std::max(peak_mean, sum.norm() / covered);
}

std::vector<double> ForceRecord::to_numbers() const {
  std::vector<double> numbers = {window, peak,    peak_time, peak_mean, first,
                                 last,   covered, total.x(), total.y(), total.z()};
  for (const Sample& sample : recent)
    numbers.insert(numbers.end(),
                   {sample.time_step, sample.impulse.x(), sample.impulse.y(), sample.impulse.z()});
  return numbers;
}

ForceRecord ForceRecord::from_numbers(std::span<const double> numbers, const std::string& where) {
  constexpr std::size_t head = 10, row = 4;
  if (numbers.size() < head || (numbers.size() - head) % row != 0)
    throw dem::InputError(where, fmt::format("a record of the contact force has {} numbers", numbers.size()),
                          fmt::format("{} and a multiple of {} are expected", head, row));
  ForceRecord record(numbers[0]);
  record.peak = numbers[1], record.peak_time = numbers[2], record.peak_mean = numbers[3];
  record.first = numbers[4], record.last = numbers[5], record.covered = numbers[6];
  record.total = {numbers[7], numbers[8], numbers[9]};
  for (std::size_t k = head; k < numbers.size(); k += row)
    record.recent.push_back({numbers[k], {numbers[k + 1], numbers[k + 2], numbers[k + 3]}});
  return record;
}

ForceRecord reduce(std::span<const double> time, std::span<const Vec3> force, double window) {
  if (time.size() != force.size())
    throw dem::InputError("contact force", fmt::format("{} times and {} forces", time.size(), force.size()),
                          "every force needs a time");
  ForceRecord record(window);
  const double step = time.size() > 1 ? (time.back() - time.front()) / static_cast<double>(time.size() - 1) : 0;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (n > 0 && !(time[n] > time[n - 1]))
      throw dem::InputError("contact force", fmt::format("time {} s follows {} s", time[n], time[n - 1]),
                            "time must increase");
    record.add(time[n], step, force[n]);
  }
  return record;
}

}  // namespace impact
