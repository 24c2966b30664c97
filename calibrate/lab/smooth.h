// Smoothing that leaves the peak where it is, and resampling onto a uniform grid.
#pragma once
#include "calibrate/lab/steps.h"

namespace lab {

struct SmoothOptions {
  bool enabled = true;
  double window = 0.04;  ///< half width of the local fit, as a fraction of the strain at the peak
  int min_rows = 7;      ///< the window widens until it holds so many rows
  int max_rows = 2000;   ///< longer branches are averaged down to so many rows first
};

struct ResampleOptions {
  int points_to_peak = 100;  ///< intervals between the origin and the peak; the same step goes on after it
  int max_points = 20000;    ///< a curve that would need more is refused
};

/// Scatter of the stress about its local straight line before the peak, Pa (robust: from the median).
double stress_noise(const LabCurve& curve);

/// The peak of a noisy curve: the vertex of a parabola through the rows that noise alone could have made the
/// highest. Without noise, the highest row itself.
struct Peak {
  double strain = 0;
  double stress = 0;
};
Peak find_peak(const LabCurve& curve);

/// Local quadratic regression (tricube weights), before and after the peak apart, so that a sudden fall stays
/// sudden and the peak (find_peak) stays. Needs strictly increasing strain.
LabCurve smooth(const LabCurve& curve, const SmoothOptions& options = {});

/// Steffen's monotone interpolation onto a uniform grid of strain from 0, with the peak on a point. Needs
/// strictly increasing strain that starts at 0. Throws dem::InputError if the grid would be larger than
/// max_points.
LabCurve resample(const LabCurve& curve, const ResampleOptions& options = {});

/// The stress at each strain by Steffen's interpolation; 0 outside the curve. Needs strictly increasing strain.
std::vector<double> interpolate(const LabCurve& curve, const std::vector<double>& strain);

}  // namespace lab
