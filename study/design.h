// Which values the varied parameters take: every combination, or points of a Sobol sequence.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "study/study_file.h"

namespace study {

/// GSL's Sobol sequence has so many dimensions.
inline constexpr std::size_t most_sobol_dimensions = 40;

/// One setting of the varied parameters.
struct DesignPoint {
  std::vector<double> values;  ///< SI, one for each of Study::parameters
  /// Of a sensitivity design (Saltelli et al., Comput. Phys. Commun. 181, 2010): "A", "B", or "AB1", "AB2", ...
  /// where point AB_i is row A with its i-th value taken from B. Empty in other designs.
  std::string block;
  std::size_t base = 0;  ///< of a sensitivity design: the row of A and B, from 0
};

/// The value at `share` (0 to 1) of the parameter's range.
double within_range(const Parameter& parameter, double share);

/// Factorial: the last parameter changes fastest; one empty point if nothing varies. Sobol: the sequence of
/// GSL (after Antonov and Saleev) from its first point; for sensitivity the N (d + 2) points of
/// statistics::sobol_design, row by row A, B, AB_1 ... AB_d. Throws InputError if there would be more than a
/// million.
std::vector<DesignPoint> design_points(const Study& study);

}  // namespace study
