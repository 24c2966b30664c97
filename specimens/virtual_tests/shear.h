// Direct shear: a specimen cast into the two halves of a shear box.
#pragma once
#include <memory>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

struct ShearOptions {
  QuasiStaticOptions run;
  int axis = -1;             ///< across the sheared plane: 0, 1, 2; negative: the specimen's long axis
  double normal_stress = 0;  ///< on the plane, compression, held constant [Pa]
  double gap = 0;            ///< between the half-boxes [m]; 0: three element sizes
};

/// After the ISRM's suggested method for the shear strength of rock (and ASTM D5607). Cast into a half-box are
/// the elements within an element size of the specimen's surface, on its side of the gap. The lower half-box
/// stands. The upper one moves at constant speed along the next axis after `axis` (x, y, z, x); along `axis` it
/// is carried by the specimen under the normal force, as a rigid body of its elements' mass, damped as they
/// are; it does not tilt. The normal force grows first, within half the time to the elastic peak, then the
/// shearing begins. Curve: displacement, force, stress = P / A over the whole section, dilation (how far the
/// half-boxes part), normal stress.
///
/// Throws InputError if the gap leaves no half-box, or a cylinder is to be sheared along its axis.
std::unique_ptr<Rig> make_shear_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                    const ShearOptions& options);

}  // namespace virtual_tests
