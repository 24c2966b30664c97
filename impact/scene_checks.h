// Checks of a scene that need geometry but no run.
#pragma once
#include "impact/scene.h"

namespace impact {

/// By how much an impactor that flies along `approach` passes the box [low, high] [m]; 0 or less: it meets it.
/// Of shapes with dents their hull counts. Never more than the true distance, which it falls short of by 1e-5.
double distance_past(const Shape& shape, const Approach& approach, const Vec3& low, const Vec3& high);

}  // namespace impact
