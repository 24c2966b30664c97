// Numbers that a curve stands for.
#pragma once
#include <optional>
#include <vector>

#include "calibrate/lab/steps.h"

namespace lab {

struct OpeningCurve;

/// The highest stress, Pa, and its strain.
double strength(const LabCurve& curve);
double strain_at_peak(const LabCurve& curve);

/// The secant of EN 12390-13, Pa: between one tenth and one third of the strength (or of `strength`, Pa, if it
/// was found on other specimens). Throws dem::InputError if the curve has no stress there.
double secant_modulus(const LabCurve& curve);
double secant_modulus(const LabCurve& curve, double strength, double lower = 1.0 / 10, double upper = 1.0 / 3);

/// The slope of the line fitted between `lower` and `upper` of the strength, Pa. About 1% above the secant on a
/// specimen that was preloaded: its reloading is slightly S-shaped, and a fit weighs the steep middle more than
/// the ends. Throws dem::InputError as secant_modulus does.
double fitted_modulus(const LabCurve& curve, double lower = 0.10, double upper = 0.33);

/// The strain after the peak at which the stress has fallen to `fraction` of the strength; nothing if it never
/// does.
std::optional<double> strain_after_peak(const LabCurve& curve, double fraction);

/// Area under stress against opening, N/m, to the last row, or extended to zero stress by the secant of the
/// last quarter if `to_zero`. Throws dem::InputError if the stress has not fallen below one third of its peak.
double fracture_energy(const OpeningCurve& curve, bool to_zero = false);

/// The line stress = slope (strain - origin) through the rows before the peak between two fractions of the
/// strength.
struct StraightPart {
  double slope = 0;   ///< Pa
  double origin = 0;  ///< -
};
StraightPart fit_straight_part(const LabCurve& curve, double lower, double upper);

}  // namespace lab
