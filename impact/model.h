// What moves in an impact, made from the scene: discrete elements, finite elements and their ties, the
// impactor, and what holds them.
#pragma once
#include <memory>
#include <vector>

#include "impact/coupling/sub_stepping.h"
#include "impact/coupling/zone.h"
#include "impact/fe/locator.h"
#include "impact/scene.h"
#include "libdem/run/step.h"
#include "specimens/specimen.h"

namespace impact {

/// The finite elements of the coupled model. What refers to each other does so by number, so this can be moved.
struct FiniteDomain {
  fe::Mesh mesh;
  coupling::Zone zone;
  std::unique_ptr<fe::Body> body;
  fe::State nodes;
  coupling::Multipliers ties;
  coupling::SubStepping sub_stepping;
  double material_young_modulus = 0, material_poisson_ratio = 0;  ///< given, or measured on the pack
};

/// A motion that a support takes away, of one element or node.
struct Held {
  std::int32_t number = 0;
  std::array<bool, 3> axes = {false, false, false};
};

/// Where a probe reads: a discrete element, or a point of a finite element.
struct ProbePlace {
  std::int32_t element = -1;  ///< discrete; -1: finite
  fe::PointInMesh point;
};

struct ImpactModel {
  specimens::Specimen specimen;          ///< of the discrete elements, in its own coordinates
  Vec3 origin = Vec3::Zero();            ///< of the specimen in the structure's coordinates [m]
  dem::Assembly assembly;                ///< in the structure's coordinates
  std::unique_ptr<FiniteDomain> finite;  ///< coupled only
  std::vector<Held> held_elements, held_nodes;
  std::vector<ProbePlace> probes;  ///< in the scene's order
  double critical_time_step = 0;   ///< of links and contacts with the impactor together [s]
  double time_step = 0;            ///< [s]
  double solid_fraction = 0;       ///< of the pack
  std::vector<std::string> warnings;

  /// Displacement at a probe [m].
  Vec3 displacement_at(const ProbePlace& place) const;
};

/// Packs or reads the structure and puts everything in its place. Throws InputError if the scene does not fit
/// together (a support that holds nothing, elements outside every hexahedron), RunError, Interrupted.
ImpactModel make_model(const Scene& scene, int threads, const dem::ProgressCallback& progress);

/// The impactor where it just touches the structure along its path, in motion. Throws InputError if it starts
/// inside or never meets it.
ImpactorState start_of(const Scene& scene, const ImpactModel& model);

}  // namespace impact
