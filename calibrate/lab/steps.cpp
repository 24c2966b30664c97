#include "calibrate/lab/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "calibrate/lab/measure.h"
#include "libdem/core/error.h"

namespace lab {
namespace {

using dem::InputError;

template <class T>
void keep_range(std::vector<T>& values, std::size_t begin, std::size_t end) {
  if (values.empty()) return;
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(end), values.end());
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(begin));
}

void keep_rows(LabCurve& curve, std::size_t begin, std::size_t end) {
  keep_range(curve.strain, begin, end);
  keep_range(curve.stress, begin, end);
  keep_range(curve.post_peak_strain, begin, end);
  keep_range(curve.row, begin, end);
}

std::string place(const LabCurve& curve, std::size_t index) {
  return curve.row.size() == curve.size() ? fmt::format("{}: row {}", curve.file, curve.row[index])
                                          : curve.file;
}

int row_of(const LabCurve& curve, std::size_t index) {
  return curve.row.size() == curve.size() ? curve.row[index] : static_cast<int>(index) + 1;
}

void refuse_wrong_sign(const LabCurve& curve) {
  const auto [low, high] = std::ranges::minmax_element(curve.stress);
  if (*high > 0 && -*low < 3 * *high) return;
  const bool compression = curve.loading == Loading::compression;
  throw InputError(
      curve.file,
      fmt::format("the stress runs from {:.4g} to {:.4g} MPa, {} positive: no {} test", *low / 1e6, *high / 1e6,
                  compression ? "compression" : "tension", compression ? "compression" : "tension"),
      "name the other sign convention: sign = \"compression_positive\", \"tension_positive\" or "
      "\"negative_is_compression\"");
}

void refuse_spike(const LabCurve& curve, std::size_t peak, double spike) {
  double neighbours = -HUGE_VAL;
  for (std::size_t k = peak < 2 ? 0 : peak - 2; k < std::min(peak + 3, curve.size()); ++k)
    if (k != peak) neighbours = std::max(neighbours, curve.stress[k]);
  if (curve.stress[peak] > (1 + spike) * neighbours)
    throw InputError(place(curve, peak),
                     fmt::format("the stress of {:.4g} MPa sticks out of its neighbours (at most {:.4g} MPa)",
                                 curve.stress[peak] / 1e6, neighbours / 1e6),
                     "leave the row out by a # in front if it is a disturbance");
}

/// Where the last loading begins: the bottom of the last unloading during which the strain went back too.
std::size_t start_of_loading(const LabCurve& curve, std::size_t peak, const CheckOptions& options) {
  std::vector<double> largest_strain(curve.size());
  std::partial_sum(curve.strain.begin(), curve.strain.end(), largest_strain.begin(),
                   [](double a, double b) { return std::max(a, b); });
  std::size_t valley = peak;
  for (std::size_t k = peak; k-- > 0;) {
    if (curve.stress[k] < curve.stress[valley]) valley = k;
    if (curve.stress[k] > curve.stress[valley] + options.unload_depth * curve.stress[peak]) {
      // A fall of the stress alone is no unloading: a crack may open, or the machine may pause.
      const double went_back = largest_strain[valley] - curve.strain[valley];
      if (went_back > options.strain_noise * std::abs(curve.strain[peak] - curve.strain[valley])) return valley;
    }
  }
  return 0;
}

void refuse_backwards(const LabCurve& curve, double tolerance) {
  std::size_t largest = 0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    if (curve.strain[k] < curve.strain[largest] - tolerance)
      throw InputError(place(curve, k),
                       fmt::format("the strain goes backwards, to {:.4g} after {:.4g} in row {}",
                                   curve.strain[k], curve.strain[largest], row_of(curve, largest)),
                       "keep one monotonic branch: only_rows = { column = \"phase\", equals = 1 }, or a # in "
                       "front of the rows of the loop");
    if (curve.strain[k] > curve.strain[largest]) largest = k;
  }
}

/// Names the units in which an implausible value would be plausible.
std::string unit_hint(double value, double low, double high,
                      const std::vector<std::pair<double, const char*>>& units) {
  std::string names;
  for (const auto& [factor, name] : units)
    if (value * factor >= low && value * factor <= high)
      names += fmt::format("{}{}", names.empty() ? "" : " or ", name);
  return names.empty() ? "check the column and its unit"
                       : fmt::format("check the unit: as {} it would be plausible", names);
}

void refuse_implausible(const LabCurve& curve, std::size_t peak, const CheckOptions& options) {
  const double top = curve.stress[peak];
  if (top < options.min_strength || top > options.max_strength)
    throw InputError(curve.file,
                     fmt::format("a strength of {:.4g} MPa is outside {:g} to {:g} MPa", top / 1e6,
                                 options.min_strength / 1e6, options.max_strength / 1e6),
                     unit_hint(top, options.min_strength, options.max_strength,
                               {{1e6, "MPa instead of Pa"},
                                {1e-6, "Pa instead of MPa"},
                                {1e-3, "kPa instead of MPa or MPa instead of GPa"},
                                {1e3, "MPa instead of kPa"},
                                {1e9, "MPa instead of mPa"}}));
  const double strain = curve.strain[peak] - curve.strain.front();
  if (strain < options.min_peak_strain || strain > options.max_peak_strain)
    throw InputError(curve.file,
                     fmt::format("a strain at the peak of {:.4g} is outside {:g} to {:g}", strain,
                                 options.min_peak_strain, options.max_peak_strain),
                     unit_hint(strain, options.min_peak_strain, options.max_peak_strain,
                               {{1e-3, "permil instead of -"},
                                {1e-2, "% instead of -"},
                                {1e-6, "um/m instead of -"},
                                {1e3, "- instead of permil"},
                                {1e6, "- instead of um/m"}}));
}

void refuse_missing_peak(const LabCurve& curve, std::size_t peak, const CheckOptions& options) {
  const double top = curve.stress[peak];
  const auto after =
      std::min_element(curve.stress.begin() + static_cast<std::ptrdiff_t>(peak), curve.stress.end());
  if (options.may_end_at_peak || *after <= (1 - options.fall_after_peak) * top) return;
  const auto strain_at = [&](double fraction) {  // last crossing before the peak
    std::size_t k = peak;
    while (k > 0 && curve.stress[k] > fraction * top) --k;
    return curve.strain[k];
  };
  const double last_slope = 0.05 * top / std::max(curve.strain[peak] - strain_at(0.95), 1e-12);
  const double first_slope = 0.23 * top / std::max(strain_at(0.33) - strain_at(0.10), 1e-12);
  if (last_slope <= options.flat_at_end * first_slope) return;
  throw InputError(place(curve, peak),
                   fmt::format("the stress still rises at its highest, {:.4g} MPa: no peak", top / 1e6),
                   "give a test to failure; if the specimen did fail there, write may_end_at_peak = true");
}

}  // namespace

std::size_t peak_index(const LabCurve& curve) {
  return static_cast<std::size_t>(std::distance(curve.stress.begin(), std::ranges::max_element(curve.stress)));
}

LabCurve join_post_peak(const LabCurve& curve) {
  LabCurve joined = curve;
  if (curve.post_peak_strain.empty()) return joined;
  const std::size_t peak = peak_index(curve);
  const double shift = curve.strain[peak] - curve.post_peak_strain[peak];
  for (std::size_t k = peak; k < curve.size(); ++k) joined.strain[k] = curve.post_peak_strain[k] + shift;
  joined.post_peak_strain.clear();
  joined.notes.push_back(
      fmt::format("after the peak the second strain drives, shifted by {:.3g} permil", shift * 1e3));
  return joined;
}

LabCurve loading_branch(const LabCurve& curve, const CheckOptions& options) {
  const auto min_rows = static_cast<std::size_t>(std::max(options.min_rows, 3));
  if (curve.size() < min_rows)
    throw InputError(curve.file, fmt::format("a curve of {} row{}", curve.size(), curve.size() == 1 ? "" : "s"),
                     fmt::format("give at least {}", min_rows));
  refuse_wrong_sign(curve);
  std::size_t peak = peak_index(curve);
  refuse_spike(curve, peak, options.spike);

  LabCurve branch = curve;
  std::size_t start = start_of_loading(curve, peak, options);
  if (start > 0 && curve.stress[start] > 0.1 * curve.stress[peak])
    throw InputError(
        place(curve, start),
        fmt::format(
            "the strain goes backwards here, and the loading to the peak begins at {:.3g} of {:.3g} MPa",
            curve.stress[start] / 1e6, curve.stress[peak] / 1e6),
        "correct the row, or leave it out by a # in front; after cycles, the last loading must begin below one "
        "tenth of the strength");
  if (start > 0)
    branch.notes.push_back(
        fmt::format("{} rows before the last loading left out (up to row {})", start, row_of(curve, start)));
  for (std::size_t k = peak; k-- > start;) {
    if (curve.stress[k] < options.seating * curve.stress[peak]) {
      start = k + 1;
      break;
    }
  }
  keep_rows(branch, start, branch.size());
  branch = join_post_peak(branch);
  peak = peak_index(branch);

  std::size_t end = peak + 1;  // behind the largest strain while the stress is above zero
  for (std::size_t k = peak + 1; k < branch.size() && branch.stress[k] > 0; ++k)
    if (branch.strain[k] >= branch.strain[end - 1]) end = k + 1;
  if (end < branch.size())
    branch.notes.push_back(
        fmt::format("{} rows after the largest strain or below zero stress left out (from row {})",
                    branch.size() - end, row_of(branch, end)));
  keep_rows(branch, 0, end);
  return branch;
}

void check_curve(const LabCurve& curve, const CheckOptions& options) {
  if (curve.size() == 0) throw InputError(curve.file, "a curve without rows", "");
  const std::size_t peak = peak_index(curve);
  const double strain = curve.strain[peak] - curve.strain.front();
  if (strain < 0)
    throw InputError(
        place(curve, peak),
        fmt::format("the strain falls from {:.4g} to {:.4g} while the stress rises to its peak",
                    curve.strain.front(), curve.strain[peak]),
        "if the strain has another sign than the stress, say so with strain_sign = \"...\"; if the rows are in "
        "reverse order, turn them");
  if (curve.size() < static_cast<std::size_t>(options.min_rows) || peak < 5)
    throw InputError(
        curve.file,
        fmt::format("{} rows of the last loading and after it, {} of them before the peak", curve.size(), peak),
        fmt::format("give at least {} rows, 5 of them before the peak", options.min_rows));
  refuse_implausible(curve, peak, options);
  refuse_backwards(curve, options.strain_noise * strain);
  refuse_missing_peak(curve, peak, options);
}

LabCurve make_increasing(const LabCurve& curve) {
  struct Pool {
    double strain, stress, rows;
    void add(const Pool& other) {
      strain = (strain * rows + other.strain * other.rows) / (rows + other.rows);
      stress = (stress * rows + other.stress * other.rows) / (rows + other.rows);
      rows += other.rows;
    }
  };
  LabCurve result = curve;
  result.strain.clear();
  result.stress.clear();
  result.row.clear();
  const std::size_t peak = peak_index(curve);
  const auto append = [&](std::size_t begin, std::size_t end) {
    std::vector<Pool>
        pools;  // pool adjacent violators: the nearest increasing sequence in the least squares sense
    for (std::size_t k = begin; k < end; ++k) {
      // The peak is no mean of its neighbours: rows on its wrong side, within the noise, go.
      if (k < peak ? curve.strain[k] >= curve.strain[peak] : k > peak && curve.strain[k] <= curve.strain[peak])
        continue;
      pools.push_back({curve.strain[k], curve.stress[k], 1});
      while (pools.size() > 1 && pools[pools.size() - 2].strain >= pools.back().strain) {
        pools[pools.size() - 2].add(pools.back());
        pools.pop_back();
      }
    }
    for (const Pool& pool : pools) {
      result.strain.push_back(pool.strain);
      result.stress.push_back(pool.stress);
    }
  };
  append(0, peak);
  append(peak, peak + 1);
  append(peak + 1, curve.size());
  if (result.size() < curve.size())
    result.notes.push_back(
        fmt::format("{} rows pooled where the strain stood still or stepped back within the noise",
                    curve.size() - result.size()));
  return result;
}

LabCurve correct_toe(const LabCurve& curve, const ToeOptions& options) {
  LabCurve result = curve;
  const std::size_t peak = peak_index(curve);
  double shift = 0;
  bool apply = false;
  if (options.enabled) {
    const StraightPart line = fit_straight_part(curve, options.lower, options.upper);
    shift = line.origin;
    apply = std::abs(shift) > options.ignore_below * (curve.strain[peak] - line.origin);
    result.notes.push_back(
        fmt::format("the straight part meets zero stress at {:.3g} permil: {}", shift * 1e3,
                    apply ? "the origin was moved there" : "within the curvature, left alone"));
  }
  if (!apply) shift = 0;
  result.toe_shift = shift;
  result.row.clear();
  result.strain = {0};
  result.stress = {0};
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double strain = curve.strain[k] - shift;
    const bool toe =
        k < peak && (strain <= 0 || (apply && curve.stress[k] < options.lower * curve.stress[peak]));
    if (toe) continue;
    result.strain.push_back(strain);
    result.stress.push_back(curve.stress[k]);
  }
  return result;
}

}  // namespace lab
