#include "calibrate/lab/smooth.h"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_spline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "libdem/core/error.h"

namespace lab {
namespace {

template <auto release>
struct Release {
  template <class T>
  void operator()(T* pointer) const {
    release(pointer);
  }
};
using Vector = std::unique_ptr<gsl_vector, Release<gsl_vector_free>>;
using Matrix = std::unique_ptr<gsl_matrix, Release<gsl_matrix_free>>;
using Workspace = std::unique_ptr<gsl_multifit_linear_workspace, Release<gsl_multifit_linear_free>>;
using Spline = std::unique_ptr<gsl_spline, Release<gsl_spline_free>>;
using Accelerator = std::unique_ptr<gsl_interp_accel, Release<gsl_interp_accel_free>>;

/// GSL's own handler ends the process; here a failed call must come back as a status.
class QuietGsl {
 public:
  QuietGsl() : previous(gsl_set_error_handler_off()) {}
  ~QuietGsl() { gsl_set_error_handler(previous); }
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;

 private:
  gsl_error_handler_t* previous;
};

struct Parabola {
  double value = 0, slope = 0,
         curvature = 0;  ///< of y = value + slope t + curvature t2, t = (x - centre)/scale
};

/// Weighted least squares; x, y, weight of the same size. A straight line when there are fewer than five
/// points.
std::optional<Parabola> fit_parabola(std::span<const double> x, std::span<const double> y,
                                     std::span<const double> weight, double centre, double scale) {
  const QuietGsl quiet;
  const std::size_t rows = x.size();
  const std::size_t terms = rows < 5 ? 2 : 3;
  if (rows < terms) return std::nullopt;
  const Matrix design(gsl_matrix_alloc(rows, terms));
  const Vector values(gsl_vector_alloc(rows)), weights(gsl_vector_alloc(rows)),
      solution(gsl_vector_alloc(terms));
  const Matrix covariance(gsl_matrix_alloc(terms, terms));
  const Workspace workspace(gsl_multifit_linear_alloc(rows, terms));
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = (x[k] - centre) / scale;
    gsl_matrix_set(design.get(), k, 0, 1);
    gsl_matrix_set(design.get(), k, 1, t);
    if (terms == 3) gsl_matrix_set(design.get(), k, 2, t * t);
    gsl_vector_set(values.get(), k, y[k]);
    gsl_vector_set(weights.get(), k, weight.empty() ? 1.0 : weight[k]);
  }
  double squares = 0;
  if (gsl_multifit_wlinear(design.get(), weights.get(), values.get(), solution.get(), covariance.get(),
                           &squares, workspace.get()) != GSL_SUCCESS)
    return std::nullopt;
  const Parabola fit{gsl_vector_get(solution.get(), 0), gsl_vector_get(solution.get(), 1),
                     terms == 3 ? gsl_vector_get(solution.get(), 2) : 0};
  if (!std::isfinite(fit.value) || !std::isfinite(fit.slope) || !std::isfinite(fit.curvature))
    return std::nullopt;
  return fit;
}

struct Branch {
  std::vector<double> strain, stress;
  std::size_t size() const { return strain.size(); }
};

/// Means of consecutive rows, so that a branch has at most `max_rows`.
Branch thinned(const Branch& branch, int max_rows) {
  const std::size_t group =
      (branch.size() + static_cast<std::size_t>(max_rows) - 1) / static_cast<std::size_t>(max_rows);
  if (group <= 1) return branch;
  Branch result;
  for (std::size_t begin = 0; begin < branch.size(); begin += group) {
    const std::size_t end = std::min(begin + group, branch.size());
    double strain = 0, stress = 0;
    for (std::size_t k = begin; k < end; ++k) {
      strain += branch.strain[k];
      stress += branch.stress[k];
    }
    result.strain.push_back(strain / static_cast<double>(end - begin));
    result.stress.push_back(stress / static_cast<double>(end - begin));
  }
  return result;
}

/// Local regression of one branch with the peak as its last (or first) point.
std::vector<double> smoothed(const Branch& branch, double half_width, int min_rows) {
  const auto& x = branch.strain;
  const auto least = std::min(static_cast<std::size_t>(std::max(min_rows, 5)), x.size());
  std::vector<double> result = branch.stress;
  std::vector<double> weight;
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::size_t begin = k, end = k + 1;
    const auto distance_below = [&] { return begin > 0 ? x[k] - x[begin - 1] : HUGE_VAL; };
    const auto distance_above = [&] { return end < x.size() ? x[end] - x[k] : HUGE_VAL; };
    while (end - begin < x.size()) {
      const double next = std::min(distance_below(), distance_above());
      if (end - begin >= least && next > half_width) break;
      if (distance_below() <= distance_above())
        --begin;
      else
        ++end;
    }
    const double reach = 1.0001 * std::max({half_width, x[k] - x[begin], x[end - 1] - x[k]});
    weight.clear();
    for (std::size_t j = begin; j < end; ++j) {
      const double t = std::abs(x[j] - x[k]) / reach;
      weight.push_back(std::pow(1 - t * t * t, 3));
    }
    const auto fit = fit_parabola(std::span(x).subspan(begin, end - begin),
                                  std::span(branch.stress).subspan(begin, end - begin), weight, x[k], reach);
    if (fit) result[k] = fit->value;
  }
  return result;
}

}  // namespace

double stress_noise(const LabCurve& curve) {
  std::vector<double> residual;
  for (std::size_t k = 1; k + 1 <= peak_index(curve); ++k) {
    const double part = (curve.strain[k] - curve.strain[k - 1]) / (curve.strain[k + 1] - curve.strain[k - 1]);
    const double line = (1 - part) * curve.stress[k - 1] + part * curve.stress[k + 1];
    const double spread = std::sqrt(1 + (1 - part) * (1 - part) + part * part);
    residual.push_back(std::abs(curve.stress[k] - line) / spread);
  }
  if (residual.size() < 5) return 0;
  const auto middle = residual.begin() + static_cast<std::ptrdiff_t>(residual.size() / 2);
  std::ranges::nth_element(residual, middle);
  return *middle / 0.6745;  // the median of |x| of a normal variable is 0.6745 of its standard deviation
}

Peak find_peak(const LabCurve& curve) {
  const std::size_t top = peak_index(curve);
  const Peak highest{curve.strain[top], curve.stress[top]};
  const double noise = stress_noise(curve);
  if (noise < 2e-4 * highest.stress) return highest;  // the row itself is as good as any fit
  // Rows that may be the peak but for the noise. Single rows below do not end the window, three in turn do.
  const double level = highest.stress - std::min(8 * noise, 0.1 * highest.stress);
  const auto reach = [&](int step) {
    std::size_t last = top;
    int below = 0;
    for (auto k = static_cast<std::ptrdiff_t>(top) + step;
         k >= 0 && k < static_cast<std::ptrdiff_t>(curve.size()); k += step) {
      const bool high = curve.stress[static_cast<std::size_t>(k)] >= level;
      below = high ? 0 : below + 1;
      if (high) last = static_cast<std::size_t>(k);
      if (below == 3) break;
    }
    return last;
  };
  const std::size_t begin = reach(-1), end = reach(+1) + 1;
  const double scale = curve.strain[end - 1] - curve.strain[begin];
  const auto fit = end - begin < 5 ? std::nullopt
                                   : fit_parabola(std::span(curve.strain).subspan(begin, end - begin),
                                                  std::span(curve.stress).subspan(begin, end - begin), {},
                                                  highest.strain, scale);
  if (!fit) return highest;
  // The vertex, held inside the window: where the stress falls suddenly the highest fitted point is at its
  // edge.
  const double first = (curve.strain[begin] - highest.strain) / scale;
  const double last = (curve.strain[end - 1] - highest.strain) / scale;
  double t = fit->curvature < 0 ? -fit->slope / (2 * fit->curvature) : fit->slope > 0 ? last : first;
  t = std::clamp(t, first, last);
  return {highest.strain + t * scale, fit->value + fit->slope * t + fit->curvature * t * t};
}

LabCurve smooth(const LabCurve& curve, const SmoothOptions& options) {
  const Peak peak = find_peak(curve);
  Branch before, after;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    Branch& branch = curve.strain[k] < peak.strain ? before : after;
    if (curve.strain[k] == peak.strain) continue;
    branch.strain.push_back(curve.strain[k]);
    branch.stress.push_back(curve.stress[k]);
  }
  LabCurve result = curve;
  result.strain.clear();
  result.stress.clear();
  result.row.clear();
  const double half_width = options.window * peak.strain;
  const auto append = [&](const Branch& raw) {
    const Branch branch = thinned(raw, options.max_rows);
    const std::vector<double> stress = smoothed(branch, half_width, options.min_rows);
    for (std::size_t k = 0; k < branch.size(); ++k) {
      result.strain.push_back(branch.strain[k]);
      // Below the peak by a hair, so that it stays the one highest point.
      result.stress.push_back(std::clamp(stress[k], 0.0, (1 - 1e-9) * peak.stress));
    }
  };
  append(before);
  result.strain.push_back(peak.strain);
  result.stress.push_back(peak.stress);
  append(after);
  if (!result.strain.empty() && curve.strain.front() == 0 && curve.stress.front() == 0) {
    // The origin is exact. With averaged rows it lies in the first mean, and comes back in front of it.
    if (result.strain.front() > 0) {
      result.strain.insert(result.strain.begin(), 0);
      result.stress.insert(result.stress.begin(), 0);
    }
    result.stress.front() = 0;
  }
  return result;
}

std::vector<double> interpolate(const LabCurve& curve, const std::vector<double>& strain) {
  const QuietGsl quiet;
  if (curve.size() < 3)
    throw dem::InputError(curve.file, "too few points to interpolate", "give at least three");
  const Spline spline(gsl_spline_alloc(gsl_interp_steffen, curve.size()));
  if (gsl_spline_init(spline.get(), curve.strain.data(), curve.stress.data(), curve.size()) != GSL_SUCCESS)
    throw dem::InputError(curve.file, "the strain does not increase strictly", "check the strain column");
  const Accelerator accelerator(gsl_interp_accel_alloc());
  std::vector<double> stress;
  for (const double x : strain) {
    const bool inside = x >= curve.strain.front() && x <= curve.strain.back();
    stress.push_back(inside ? gsl_spline_eval(spline.get(), x, accelerator.get()) : 0.0);
  }
  return stress;
}

LabCurve resample(const LabCurve& curve, const ResampleOptions& options) {
  const std::size_t peak = peak_index(curve);
  const double step = curve.strain[peak] / std::max(options.points_to_peak, 1);
  const double intervals = std::floor(curve.strain.back() / step + 1e-9);
  if (!(intervals < options.max_points))
    throw dem::InputError(
        curve.file,
        fmt::format("the curve ends at {:.3g}, {:.0f} times the strain at its peak: {:.0f} points",
                    curve.strain.back(), curve.strain.back() / curve.strain[peak], intervals),
        fmt::format("at most {} are allowed; cut the tail", options.max_points));
  LabCurve result = curve;
  result.row.clear();
  result.strain.clear();
  for (int k = 0; k <= static_cast<int>(intervals); ++k)
    result.strain.push_back(k == options.points_to_peak ? curve.strain[peak]
                                                        : std::min(k * step, curve.strain.back()));
  result.stress = interpolate(curve, result.strain);
  return result;
}

}  // namespace lab
