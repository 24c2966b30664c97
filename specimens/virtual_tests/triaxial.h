// Triaxial compression: a fluid's pressure on the sides, then axial compression to past the peak.
#pragma once
#include <memory>

#include "libdem/drive/platens.h"
#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"

namespace virtual_tests {

struct TriaxialOptions {
  QuasiStaticOptions run;
  int axis = -1;           ///< 0, 1, 2; negative: the specimen's long axis
  double confinement = 0;  ///< pressure on the sides [Pa]; 0: 4.5 MPa
  dem::EndCondition ends = dem::EndCondition::free;
  double uniaxial_strength = 0;  ///< for the confinement factor [Pa]; 0: none is given
};

/// Two phases. First the pressure grows on all sides alike: on the sides as following forces of a membrane
/// (membrane.h), on the ends through two platens that float under the same stress. Then the pressure stays and
/// the platens close at constant speed. Curve: closing, force, stress (total, axial), strain between the
/// platens, pressure, the axial and lateral strains of the gauge inside (shortening positive).
///
/// Throws InputError where the specimen is too small or its axis is wrong.
std::unique_ptr<Rig> make_triaxial_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                       const TriaxialOptions& options);

}  // namespace virtual_tests
