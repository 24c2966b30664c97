// Variance-based sensitivity: which share of an output's variance comes from which input, over given ranges.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "study/statistics/bootstrap.h"

namespace study::statistics {

inline constexpr std::size_t most_sobol_inputs = 20;  ///< the sequence has 40 dimensions, two an input

/// The rows that have to be computed, each a point of the unit cube [0, 1)^inputs.
/// Two independent points A and B a base point, and for each input i the point AB_i: A with B's value of i.
/// Rows of one base point lie together, A, B, AB_1 .. AB_d, so that a smaller design is the beginning of a
/// larger one and a half-finished study can be evaluated.
struct SobolDesign {
  std::size_t inputs = 0;
  std::size_t base_points = 0;
  std::vector<std::vector<double>> points;  ///< base_points * (inputs + 2) rows

  std::size_t rows_per_base_point() const { return inputs + 2; }
};

/// From Sobol's sequence (gsl_qrng_sobol) in 2 * inputs dimensions, its digits shifted at random by `seed`: 2^k
/// base points are then spread most evenly, the first point, which is the cube's corner, included (Owen, On
/// dropping the first Sobol' point, 2020). Throws std::invalid_argument if inputs is 0 or above
/// most_sobol_inputs, or base_points is 0.
SobolDesign sobol_design(std::size_t inputs, std::size_t base_points, std::uint64_t seed = 1);

struct SobolIndex {
  double first = 0;  ///< S_i: share of the variance that fixing input i alone would remove
  double total = 0;  ///< S_Ti: share that stays when all but input i are fixed; total - first is interaction
  Interval first_interval, total_interval;
};

struct SobolIndices {
  std::size_t base_points = 0;  ///< used: those of which every row has a number
  double mean = 0, variance = 0;
  std::vector<SobolIndex> inputs;
};

/// From the outputs of a design's rows, in their order; NaN where a test failed, which drops its base point.
/// With f less its mean, V the variance over A and B, sums over N base points:
///   S_i  = 1/N sum f(B) (f(AB_i) - f(A)) / V          (Saltelli et al., Comput. Phys. Commun. 181, 2010)
///   S_Ti = 1/(2N) sum (f(A) - f(AB_i))^2 / V          (Jansen, Comput. Phys. Commun. 117, 1999)
/// Estimates can leave [0, 1] by their error, which the intervals show: base points drawn again, percentiles.
/// Indices are NaN if fewer than two base points are whole or nothing varies. Throws std::invalid_argument if
/// `outputs` is no multiple of inputs + 2 long.
SobolIndices sobol_indices(std::size_t inputs, std::span<const double> outputs,
                           BootstrapOptions options = {.resamples = 2000, .kind = IntervalKind::percentile});

}  // namespace study::statistics
