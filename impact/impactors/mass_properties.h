// Mass, centre of mass and inertia of the shapes, filled uniformly.
#pragma once
#include <string>

#include "impact/impactors/shape.h"

namespace impact {

/// Of a body of density 1 kg/m3.
struct Filled {
  double volume = 0;            ///< [m3]
  Vec3 centre = Vec3::Zero();   ///< centre of mass, in the frame of the shape [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre, along the axes of the shape's frame [m5]
};

/// Closed forms for the primitives; the divergence theorem over the triangles of a mesh.
Filled filled(const Shape& shape);
Filled filled(const TriangleMesh& surface);

/// Distance of the centre of mass of a cylinder from its back [m].
double cylinder_centre(double radius, double length, Nose nose);

struct MassProperties {
  double mass = 0;              ///< [kg]
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass, along the axes of the shape's frame [kg m2]
};

/// From a density [kg/m3] or a total mass [kg]. Throw InputError that names `where` if it is not positive and
/// finite.
MassProperties from_density(const Shape& shape, double density, const std::string& where);
MassProperties from_mass(const Shape& shape, double mass, const std::string& where);

}  // namespace impact
