// Biaxial compression: two pairs of brush platens, the second pair's stress a constant part of the first's.
#pragma once
#include <memory>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

struct BiaxialOptions {
  QuasiStaticOptions run;
  int free_axis = -1;  ///< that nothing presses on: 0, 1, 2; negative: the shortest side, the last of equals
  double ratio = 1;    ///< second stress over the first, 0 to 1
  double uniaxial_strength = 0;  ///< that the strength ratio refers to [Pa]; 0: none is given
};

/// After Kupfer, Hilsdorf and Rusch (1969). The first pair of platens, on the faces across the first axis after
/// the free one, closes at constant speed. The second pair floats under `ratio` times the stress that the first
/// feels, as a servo keeps it. Brush platens: neither holds the faces sideways. Curve: closing, force, stress
/// (of the first pair), stress_2, the three strains of the gauge inside (extension positive).
///
/// Throws InputError for a cylinder, a ratio out of range, or a specimen that is too small.
std::unique_ptr<Rig> make_biaxial_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                      const BiaxialOptions& options);

}  // namespace virtual_tests
