// A load on one element that does not come from its pairs: an impactor's push, a confining pressure.
#pragma once
#include <cstdint>

#include "libdem/core/vector.h"

namespace dem {

struct ElementLoad {
  std::int32_t element = 0;
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the element's centre [N m]
};

}  // namespace dem
