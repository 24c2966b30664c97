#include "study/statistics/sobol_indices.h"

#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "libdem/core/random.h"

namespace study::statistics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t whole = std::uint64_t{1} << 30;  ///< GSL's points have 30 binary digits

struct ReleaseSequence {
  void operator()(gsl_qrng* sequence) const { gsl_qrng_free(sequence); }
};

/// The outputs of whole base points, one a row: A, B, AB_1 .. AB_d.
struct Outputs {
  std::size_t inputs = 0;
  std::vector<const double*> rows;
};

/// S_1 .. S_d, S_T1 .. S_Td, mean, variance of the base points `drawn`.
std::vector<double> estimate(const Outputs& outputs, std::span<const std::size_t> drawn) {
  const std::size_t d = outputs.inputs;
  const auto n = static_cast<double>(drawn.size());
  std::vector<double> result(2 * d + 2, nan);
  if (drawn.size() < 2) return result;
  double mean = 0, variance = 0;
  for (const std::size_t k : drawn) mean += (outputs.rows[k][0] + outputs.rows[k][1]) / (2 * n);
  for (const std::size_t k : drawn)
    for (int half = 0; half < 2; ++half) variance += std::pow(outputs.rows[k][half] - mean, 2) / (2 * n - 1);
  result[2 * d] = mean, result[2 * d + 1] = variance;
  if (!(variance > 1e-24 * mean * mean)) return result;
  for (std::size_t i = 0; i < d; ++i) {
    double first = 0, total = 0;
    for (const std::size_t k : drawn) {
      const double* f = outputs.rows[k];
      const double step = f[2 + i] - f[0];
      first += (f[1] - mean) * step, total += step * step;
    }
    result[i] = first / n / variance;
    result[d + i] = total / (2 * n) / variance;
  }
  return result;
}

}  // namespace

SobolDesign sobol_design(std::size_t inputs, std::size_t base_points, std::uint64_t seed) {
  if (inputs == 0 || inputs > most_sobol_inputs || base_points == 0)
    throw std::invalid_argument("sobol_design: 1 to 20 inputs and at least one base point");
  const std::unique_ptr<gsl_qrng, ReleaseSequence> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(2 * inputs)));
  SobolDesign design{inputs, base_points, {}};
  design.points.reserve(base_points * design.rows_per_base_point());
  const auto width = static_cast<std::ptrdiff_t>(inputs);
  // gsl_qrng_sobol leaves out the first point of the sequence, 0 in every dimension: it is put in here.
  std::vector<double> point(2 * inputs, 0.0);
  std::vector<double> shifted(2 * inputs);
  std::vector<std::uint64_t> shift(2 * inputs);
  dem::Random random(seed);
  for (std::uint64_t& digits : shift) digits = random.below(whole);
  for (std::size_t k = 0; k < base_points; ++k) {
    if (k > 0) gsl_qrng_get(sequence.get(), point.data());
    for (std::size_t i = 0; i < 2 * inputs; ++i) {
      const auto digits = static_cast<std::uint64_t>(std::llround(point[i] * static_cast<double>(whole)));
      shifted[i] = (static_cast<double>(digits ^ shift[i]) + 0.5) / static_cast<double>(whole);
    }
    const std::vector<double> a(shifted.begin(), shifted.begin() + width),
        b(shifted.begin() + width, shifted.end());
    design.points.push_back(a);
    design.points.push_back(b);
    for (std::size_t i = 0; i < inputs; ++i) {
      design.points.push_back(a);
      design.points.back()[i] = b[i];
    }
  }
  return design;
}

SobolIndices sobol_indices(std::size_t inputs, std::span<const double> outputs, BootstrapOptions options) {
  const std::size_t width = inputs + 2;
  if (inputs == 0 || outputs.size() % width != 0)
    throw std::invalid_argument("sobol_indices: the outputs are not whole base points");
  Outputs complete{inputs, {}};
  for (std::size_t begin = 0; begin < outputs.size(); begin += width) {
    const auto row = outputs.subspan(begin, width);
    if (std::ranges::all_of(row, [](double f) { return std::isfinite(f); }))
      complete.rows.push_back(row.data());
  }
  SobolIndices result;
  result.base_points = complete.rows.size();
  std::vector<std::size_t> all(complete.rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<double> values = estimate(complete, all);
  const std::vector<Interval> intervals = bootstrap_rows(
      all.size(), [&](std::span<const std::size_t> drawn) { return estimate(complete, drawn); }, options);
  result.mean = values[2 * inputs], result.variance = values[2 * inputs + 1];
  for (std::size_t i = 0; i < inputs; ++i)
    result.inputs.push_back({values[i], values[inputs + i], intervals[i], intervals[inputs + i]});
  return result;
}

}  // namespace study::statistics
