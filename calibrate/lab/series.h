// Several specimens of one concrete: their mean curve, their scatter, and the numbers with both.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/lab/curve.h"

namespace lab {

/// A quantity measured on `count` specimens. std is the sample standard deviation (count - 1), 0 for one
/// specimen.
struct Measured {
  double mean = 0, std = 0, min = 0, max = 0;
  int count = 0;
};

/// Throws dem::InputError if there are no values.
Measured measured(const std::vector<double>& values);

struct SeriesOptions {
  int points_to_peak = 100;   ///< intervals of the mean curve between the origin and the peak
  double odd_one_out = 0.30;  ///< a strength or peak strain off the mean by more than this fraction gets a note
};

/// A mean curve has the peak of the means: the mean strength at the mean strain of the peaks. All vectors of
/// the band lie on mean.strain.
struct Series {
  std::vector<LabCurve> curves;                        ///< the specimens, prepared
  LabCurve mean;                                       ///< Pa over -, uniform in strain
  std::vector<double> low, high;                       ///< Pa: smallest and largest of the specimens
  std::vector<double> std;                             ///< Pa: sample standard deviation
  std::vector<int> count;                              ///< how many specimens reach so far
  Measured E;                                          ///< Pa, secant of EN 12390-13
  Measured strength;                                   ///< Pa
  Measured strain_at_peak;                             ///< -
  std::optional<Measured> strain_at_80, strain_at_50;  ///< - : after the peak, of the specimens that get there
  std::vector<std::string> notes;
};

/// Averages prepared curves. Each is scaled to its own peak (strain / strain at the peak, stress / strength),
/// the shapes are averaged there, and the mean shape is scaled by the mean peak: averaging at equal strain
/// would smear peaks that lie at different strains into one that is lower and wider than any. The mean ends
/// where the first specimen with a part after the peak ends; specimens that end at their peak count up to
/// there. Throws dem::InputError if there is no curve, if compression and tension are mixed, or if a curve does
/// not start at the origin.
Series average(const std::vector<LabCurve>& curves, const SeriesOptions& options = {});

/// prepare_curve on each of the files, then average. Throws dem::InputError; a file named twice is refused.
Series read_series(const CurveSpec& spec, const CurveOptions& curve_options = {},
                   const SeriesOptions& options = {});

}  // namespace lab
