// Uniaxial cyclic loading: loading, unloading, reloading along the envelope to past the peak.
#pragma once
#include <memory>

#include "libdem/drive/platens.h"
#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/rig.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace virtual_tests {

struct CyclicOptions {
  QuasiStaticOptions run;
  Loading loading = Loading::compression;
  int axis = -1;  ///< 0, 1, 2; negative: the specimen's long axis
  dem::EndCondition ends = dem::EndCondition::free;
  double increment =
      0;  ///< of the strain between two unloadings [-]; 0: 0.4 times the elastic strain at the peak
  double unload_to = 0;  ///< part of the stress at which unloading began, 0 to below 1
  int cycles = 0;        ///< at most; 0: until the test ends
};

/// The platens move at constant speed and turn where the strain between them has grown by `increment` over the
/// last turn, and again where the stress has fallen to `unload_to` of what it was (Karsan and Jirsa 1969). The
/// test ends on the envelope, never while it unloads. Curve: closing (opening in tension), force, stress,
/// strain between the platens, cycle (turns so far), the gauge's axial strain, all positive in the direction of
/// loading.
///
/// Throws InputError where the specimen is too small or its axis is wrong.
std::unique_ptr<Rig> make_cyclic_rig(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                     const CyclicOptions& options);

}  // namespace virtual_tests
