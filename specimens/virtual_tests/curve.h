// The stress-strain curve of a virtual test and what is read from it.
#pragma once
#include <string>
#include <vector>

namespace virtual_tests {

/// One window of time steps; every quantity belongs to the window's middle. Positive in the loading direction:
/// compression positive in a compression test, tension positive in a tension test.
struct CurvePoint {
  double strain = 0;        ///< between the platens [-]
  double stress = 0;        ///< mean reaction over the nominal section [Pa]
  double strain_axial = 0;  ///< of the gauge, inside the specimen [-]
  double strain_lateral =
      0;  ///< of the gauge, mean of both directions across; expansion is negative in compression [-]
  double broken = 0;      ///< broken links over initial links [-]
  double unbalanced = 0;  ///< |difference| over mean of the two platens' reactions [-]
};

using Curve = std::vector<CurvePoint>;

/// Number of the point with the highest stress.
std::size_t peak_of(const Curve& curve);

struct Moduli {
  double young_modulus = 0, poisson_ratio = 0;
};
/// Least squares between one tenth and one third of the peak stress, before the peak (as EN 12390-13 takes its
/// secant); zeros if the curve has fewer than three points there.
Moduli moduli_of(const Curve& curve);

/// Work per section area after the peak [J/m2]: stress over displacement of the platens, minus the elastic
/// energy that comes back at the end: tension's fracture energy where the curve runs to a few per cent of its
/// peak.
double work_of_fracture(const Curve& curve, double gauge_length, double young_modulus);

/// CSV with a header that names units; stress in Pa.
std::string to_csv(const Curve& curve);

}  // namespace virtual_tests
