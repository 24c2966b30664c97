#include "calibrate/lab/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/lab/measure.h"
#include "libdem/core/error.h"

namespace lab {
namespace {

using dem::InputError;

/// The curve in units of its own peak.
LabCurve normalised(const LabCurve& curve) {
  LabCurve result = curve;
  const double strain = strain_at_peak(curve);
  const double stress = strength(curve);
  for (double& x : result.strain) x /= strain;
  for (double& y : result.stress) y /= stress;
  return result;
}

/// Specimens that end (almost) at their peak say nothing about the part after it.
constexpr double beyond_the_peak = 1.02;

void refuse_mixed(const std::vector<LabCurve>& curves) {
  if (curves.empty()) throw InputError("a series of curves", "has no curve", "name at least one file");
  for (const LabCurve& curve : curves) {
    if (curve.loading != curves.front().loading)
      throw InputError(curve.file, "compression and tension in one series", "make two series of them");
    if (curve.size() < 3 || curve.strain.front() != 0)
      throw InputError(curve.file, "the curve does not start at the origin",
                       "prepare it first (prepare_curve)");
  }
}

void note_odd_ones(Series& series, double limit) {
  if (series.curves.size() < 3) return;  // of two, neither is the odd one
  for (const LabCurve& curve : series.curves) {
    const double stress = strength(curve) / series.strength.mean - 1;
    const double strain = strain_at_peak(curve) / series.strain_at_peak.mean - 1;
    if (std::abs(stress) > limit || std::abs(strain) > limit)
      series.notes.push_back(
          fmt::format("{}: strength {:+.0f}%, strain at the peak {:+.0f}% off the mean of the series",
                      curve.file, 100 * stress, 100 * strain));
  }
}

std::optional<Measured> measured_after_peak(const std::vector<LabCurve>& curves, double fraction) {
  std::vector<double> values;
  for (const LabCurve& curve : curves)
    if (const auto strain = strain_after_peak(curve, fraction)) values.push_back(*strain);
  if (values.empty()) return std::nullopt;
  return measured(values);
}

}  // namespace

Measured measured(const std::vector<double>& values) {
  if (values.empty()) throw InputError("a measured quantity", "has no values", "give at least one");
  Measured result;
  result.count = static_cast<int>(values.size());
  for (const double value : values) result.mean += value / result.count;
  for (const double value : values) result.std += (value - result.mean) * (value - result.mean);
  result.std = values.size() > 1 ? std::sqrt(result.std / (result.count - 1)) : 0;
  const auto [low, high] = std::ranges::minmax_element(values);
  result.min = *low;
  result.max = *high;
  return result;
}

Series average(const std::vector<LabCurve>& curves, const SeriesOptions& options) {
  refuse_mixed(curves);
  Series series;
  series.curves = curves;
  std::vector<double> moduli, strengths, strains;
  std::vector<LabCurve> shapes;
  double end = HUGE_VAL;
  for (const LabCurve& curve : curves) {
    moduli.push_back(secant_modulus(curve));
    strengths.push_back(strength(curve));
    strains.push_back(strain_at_peak(curve));
    shapes.push_back(normalised(curve));
    const double last = shapes.back().strain.back();
    if (last > beyond_the_peak) end = std::min(end, last);
    if (last <= beyond_the_peak && curves.size() > 1)
      series.notes.push_back(fmt::format("{}: ends at its peak, not part of the mean after it", curve.file));
  }
  if (end == HUGE_VAL) end = 1;  // no specimen shows a part after the peak
  series.E = measured(moduli);
  series.strength = measured(strengths);
  series.strain_at_peak = measured(strains);
  series.strain_at_80 = measured_after_peak(curves, 0.8);
  series.strain_at_50 = measured_after_peak(curves, 0.5);

  std::vector<double> grid;
  const int points = std::max(options.points_to_peak, 2);
  grid.reserve(static_cast<std::size_t>(end * points) + 2);
  for (int k = 0; k <= static_cast<int>(end * points + 1e-6); ++k)
    grid.push_back(std::min<double>(k, end * points) / points);
  std::vector<std::vector<double>> stresses;
  for (LabCurve& shape : shapes) stresses.push_back(interpolate(shape, grid));

  series.mean.file =
      curves.size() == 1 ? curves.front().file : fmt::format("mean of {} specimens", curves.size());
  series.mean.loading = curves.front().loading;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    std::vector<double> shape, stress;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      const bool reaches = grid[k] <= 1 || shapes[s].strain.back() > beyond_the_peak;
      // The last point of the grid may lie behind a specimen's last one by rounding.
      if (!reaches) continue;
      const double y = grid[k] > shapes[s].strain.back() ? shapes[s].stress.back() : stresses[s][k];
      shape.push_back(y);
      stress.push_back(y * strengths[s]);
    }
    const Measured band = measured(stress);
    series.mean.strain.push_back(grid[k] * series.strain_at_peak.mean);
    series.mean.stress.push_back(measured(shape).mean * series.strength.mean);
    series.low.push_back(band.min);
    series.high.push_back(band.max);
    series.std.push_back(band.std);
    series.count.push_back(band.count);
  }
  note_odd_ones(series, options.odd_one_out);
  return series;
}

Series read_series(const CurveSpec& spec, const CurveOptions& curve_options, const SeriesOptions& options) {
  std::vector<LabCurve> curves;
  std::set<std::filesystem::path> seen;
  for (const auto& file : spec.files) {
    if (!seen.insert(file.lexically_normal()).second)
      throw InputError(file.string(), "is named twice in one series", "name each specimen once");
    curves.push_back(prepare_curve(file, spec, curve_options));
  }
  return average(curves, options);
}

}  // namespace lab
