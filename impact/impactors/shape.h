// The shapes of impactors: signed distance, nearest point of the surface and outward normal. Every shape is
// described in its own frame, whose origin is its centre of mass. Lengths in metres.
#pragma once
#include <memory>
#include <variant>

#include "impact/impactors/triangle_mesh.h"
#include "libdem/core/vector.h"

namespace impact {

using dem::Mat3;
using dem::Vec3;

/// Edges along the axes.
struct Box {
  Vec3 half_size = Vec3::Zero();
};

struct Sphere {
  double radius = 0;
};

enum class Nose { flat, hemisphere };

/// A solid of revolution about z whose nose points to +z. The origin is the centre of mass, so back < 0 <
/// front.
struct Cylinder {
  double radius = 0;
  double back = 0, front = 0;  ///< z of the flat back and of the nose's tip
  Nose nose = Nose::flat;
};

/// A closed surface of triangles; shared, since it never changes.
struct Mesh {
  std::shared_ptr<const TriangleMesh> surface;
};

using Shape = std::variant<Box, Sphere, Cylinder, Mesh>;

/// Makers that check their measures and put the origin at the centre of mass. Throw InputError that names
/// `where` ("case.toml: impactor.size") if a measure is not positive and finite.
Box make_box(const Vec3& size, const std::string& where);
Sphere make_sphere(double diameter, const std::string& where);
/// `length` is that of the whole, nose included; at least the radius if the nose is a hemisphere.
Cylinder make_cylinder(double diameter, double length, Nose nose, const std::string& where);
/// Moves the vertices, so that the centre of mass of the uniformly filled surface is the origin.
Mesh make_mesh(TriangleMesh surface);

/// The point of the surface that is nearest to `point`, exact for every shape. Where several are equally near
/// (deep inside, on the medial surface) always the same one of them is taken. The distance is continuous
/// everywhere; the normal is so outside of convex shapes, edges and corners included.
Nearest nearest(const Shape& shape, const Vec3& point);

/// The smallest box along the axes that holds the shape.
Eigen::AlignedBox3d bounding_box(const Shape& shape);

/// How far the shape reaches from its centre of mass along `direction`, a unit vector in its frame [m].
double reach_along(const Shape& shape, const Vec3& direction);

/// A part of a box that can strike first. For the paper's cube all three pass through the centre of mass.
enum class Lead { face, edge, corner };

/// The rotation from the shape's frame to space that makes `lead` of a box of `half_size` point along
/// `direction` (not zero): the face +z, the middle of the edge +y +z, the corner +x +y +z. Turns the shortest
/// way; a spin about `direction` can be multiplied from the left.
Eigen::Quaterniond leading(Lead lead, const Vec3& half_size, const Vec3& direction);

}  // namespace impact
