// Which elements are linked: those nearer than a factor times the sum of their radii, the factor tuned so that
// internal elements have 12 links on average (as in a face-centred cubic assembly).
#pragma once
#include <cstddef>
#include <vector>

#include "specimens/specimen.h"

namespace specimens {

inline constexpr double wanted_coordination = 12;
/// An element is internal if it is deeper than this many element sizes: the faces cut no link of it.
inline constexpr double internal_depth = 2;

/// 1 for internal elements, 0 for the others.
std::vector<unsigned char> internal_elements(const Specimen& specimen);

/// Links of an internal element, on average; 0 if there is none.
double mean_interior_coordination(const Specimen& specimen);

/// Replaces the links and the factor. Exact: pairs are sorted by distance / (Ra + Rb), and the first so many
/// are linked that the mean is as near to 12 as counting allows. Links come out sorted by (a, b), with the
/// distance as rest length. Throws InputError if no element is internal or nearby elements are too few for 12
/// links.
void link(Specimen& specimen, int threads = 0);

}  // namespace specimens
