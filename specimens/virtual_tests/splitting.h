// Brazilian splitting: a cylinder or prism pressed along a diameter between two strips.
#pragma once
#include <memory>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

struct SplittingOptions {
  QuasiStaticOptions run;
  /// Along which it is pressed: 0, 1, 2; negative: x of a cylinder, a box's shortest side, the first of equals.
  int axis = -1;
  double strip_width = 0;  ///< of the loading strips [m]; 0: a tenth of the height along `axis`
};

/// After EN 12390-6. The strips run along the cylinder's axis, a box's longer side across `axis`. They are the
/// elements within an element size of the surface whose centres lie within half the strip's width of the
/// loaded plane; they close at constant speed and are free to move sideways. Curve: closing, force,
/// stress = 2 P / (pi L D), opening (of the middle, sideways), the strains of a gauge in the middle sideways
/// and along the load.
///
/// Throws InputError if the axis is a cylinder's own, or a strip holds fewer than 4 elements.
std::unique_ptr<Rig> make_splitting_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                        const SplittingOptions& options);

}  // namespace virtual_tests
