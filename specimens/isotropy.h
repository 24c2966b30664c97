// Whether the links point everywhere alike: the fabric tensor and the histogram of the paper's Fig. 2.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "specimens/specimen.h"

namespace specimens {

/// The orientation of the links of internal elements, each element counting its own (the faces favour links
/// along them).
struct Isotropy {
  std::size_t links = 0;                 ///< how many were counted
  dem::Mat3 fabric = dem::Mat3::Zero();  ///< mean of n n^T, trace 1
  std::array<double, 3> eigenvalues{};   ///< ascending, 1/3 each when isotropic
  double fourth_moment = 0;              ///< mean of nx^4 + ny^4 + nz^4: 0.6 when isotropic, 1 along the axes
  double tolerance = 0;                  ///< largest |eigenvalue - 1/3| that counts as isotropic
  bool isotropic = false;
};

/// Isotropic: each eigenvalue within 0.02 of 1/3, plus two standard errors of the mean of n^2 over that many
/// random directions (sqrt(4/45 / links)).
Isotropy isotropy_of(const Specimen& specimen);

/// Fig. 2: how many links point which way, projected on the planes xy, yz, zx. Bin k of `bins` covers the
/// angles k to k + 1 times pi / bins; values are relative to an even distribution (1 everywhere when
/// isotropic).
std::array<std::vector<double>, 3> orientation_histogram(const Specimen& specimen, std::size_t bins = 18);

}  // namespace specimens
