// A small slab that is struck, of discrete elements alone or coupled.
#pragma once
#include "impact/impactors/mass_properties.h"
#include "impact/scene.h"
#include "libdem/law/cohesive_link.h"

namespace impact_scene {

using namespace impact;

inline constexpr double brittle = 3.1e6, unbreakable = 1e12;  // T [Pa]

/// A square slab of 0.6 m, five or six elements thick, supported along two edges, struck in its middle by a
/// small cube.
inline Scene slab(Model model, double tensile_strength, double speed) {
  Scene scene;
  scene.title = "a small slab";
  scene.model = model;
  scene.size = Vec3(0.6, 0.6, 0.08);
  scene.card.tensile_strength = tensile_strength;
  if (tensile_strength == unbreakable) scene.card.cohesion = unbreakable;
  scene.structure.packing.size = scene.size;
  scene.structure.packing.elements = 7000;
  if (model == Model::coupled) {
    Surroundings around;
    around.zone_low = Vec3(0.14, 0.14, 0), around.zone_high = Vec3(0.46, 0.46, 0.08);
    around.box.size = scene.size;
    around.box.elements = {30, 30, 4};
    around.box.zone = fe::DiscreteZone{around.zone_low, around.zone_high, 3};
    around.overlap = 0.06;
    around.interval = 1;
    scene.structure.packing.size = around.zone_high - around.zone_low;
    scene.structure.packing.elements = 1991;
    scene.surroundings = around;
  }
  for (const double x : {0.0, 0.588})
    scene.supports.push_back(
        {x == 0 ? "left" : "right", Vec3(x, 0, 0), Vec3(x + 0.012, 0.6, 0.08), {false, false, true}});
  ContactLaw law;
  law.modulus = dem::make_link_law(scene.card).normal_modulus;
  law.shear_ratio = 0.2, law.friction = 0.3;
  const Shape shape = make_box(Vec3(0.06, 0.06, 0.06), "impactor");
  scene.impactor = Impactor{shape, RigidBody(from_density(shape, 2500, "impactor"), {}, "impactor"), law};
  scene.approach.aim = Vec3(0.3, 0.3, 0.04);
  scene.approach.speed = speed;
  scene.probes = {{"under", Vec3(0.3, 0.3, 0)}, {"aside", Vec3(0.08, 0.3, 0.04)}};
  scene.duration = 0.5e-3;
  scene.frames = 0;
  return scene;
}

}  // namespace impact_scene
