// How far a virtual curve is from a laboratory curve.
#pragma once
#include "calibrate/lab/series.h"
#include "specimens/virtual_tests/curve.h"

namespace calibrate {

/// Root mean square difference of the stresses over the laboratory's peak stress [-], on a uniform grid of
/// strains from 0 to where the laboratory curve ends or has fallen to 60% of its peak. Past the end of a
/// virtual curve its last stress counts.
double curve_difference(const virtual_tests::Curve& curve, const lab::LabCurve& laboratory);

}  // namespace calibrate
