// The surface of an impactor as triangles, for pictures. The computation itself knows the exact shapes.
#pragma once
#include <vector>

#include "impact/impactors/shape.h"

namespace impact {

struct Surface {
  std::vector<Vec3> vertices;       ///< in the frame of the shape [m]
  std::vector<Triangle> triangles;  ///< anticlockwise seen from outside
};

/// Closed. Boxes and meshes as they are; round shapes by chords, their vertices on the surface.
Surface surface_of(const Shape& shape);

}  // namespace impact
