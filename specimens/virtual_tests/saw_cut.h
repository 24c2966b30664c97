// A notch sawn into a specimen.
#pragma once
#include "specimens/specimen.h"

namespace virtual_tests {

/// A straight notch across the whole specimen: the slab between `position` -+ width/2 along `along`, from the
/// face at `from_face` (0: the low one, 1: the high one) of axis `into` to the depth `depth`.
struct SawCut {
  int along = 0, into = 2, from_face = 0;
  double position = 0, depth = 0, width = 0;  ///< [m]
};

/// The specimen without the elements whose centres lie in the notch and without the links that cross its middle
/// plane. Elements that would touch across the notch, though no link joins them any more, are cut away too:
/// of each such pair the one nearer to the middle plane. So nothing is broken and nothing pushes at the start.
/// The rest keeps its order; the nominal size stays.
specimens::Specimen cut(const specimens::Specimen& whole, const SawCut& notch);

}  // namespace virtual_tests
