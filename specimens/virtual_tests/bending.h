// Three-point bending of a prism, notched or not.
#pragma once
#include <memory>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

struct BendingOptions {
  QuasiStaticOptions run;
  int axis = -1;            ///< of the beam: 0, 1, 2; negative: the specimen's long axis
  int depth_axis = -1;      ///< along which it is loaded; negative: the larger side across, the last of equals
  double span = 0;          ///< between the supports [m]; 0: nine tenths of the length
  double notch = 0;         ///< depth of a saw cut at mid-span, from the face in tension [m]; 0: none
  double notch_width = 0;   ///< of the cut [m]; 0: an element size
  double roller_width = 0;  ///< of the strips on which rollers bear [m]; 0: one and a half element sizes
};

/// After EN 14651 and RILEM TC 50-FMC. Supports and load are strips across the beam: the elements within an
/// element size of the surface and half a roller's width of the roller's line. The supports hold them along the
/// load, the upper roller moves at constant speed; everything else is free. Curve: displacement of the upper
/// roller, force, stress = 3 P l / (2 b h^2) with the height h above the notch, deflection (of the middle of
/// the height at mid-span against that above the supports: what the rollers press in does not count), crack
/// mouth opening (between the elements beside the cut; without a cut, between strips a third of the height to
/// either side).
///
/// The fracture energy is the work of the force over the deflection to the end of the test, per ligament:
/// RILEM's (W0 + m g delta0) / A_lig, in which the weight's part is zero, since nothing weighs in the test.
///
/// Throws InputError if the shape is no box, the span does not fit, the notch is deeper than 0.6 of the height,
/// or the strips hold too few elements.
std::unique_ptr<Rig> make_bending_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                      const BendingOptions& options);

}  // namespace virtual_tests
