// Whether a specimen is large enough to stand for the material; one that is not gives numbers of its own.
#pragma once
#include <cstddef>
#include <string>

#include "specimens/specimen.h"

namespace specimens {

/// Bounds that the smallest sample of the paper's Table 1 (1,350 elements in a cube, 11 across) keeps with room
/// to spare.
inline constexpr double least_elements_across = 8;
inline constexpr std::size_t least_internal_elements = 100;

/// Why the specimen is not representative, in words; empty if it is. Looks at the number of elements across the
/// smallest side, the number of internal elements, the mean interior coordination and the isotropy of the
/// links.
std::string why_not_representative(const Specimen& specimen);

/// Throws InputError with that reason.
void require_representative(const Specimen& specimen);

/// The part of it that is known before packing. Throws InputError.
void require_enough_elements(Shape shape, const Vec3& size, std::size_t elements);

/// Another part of it, estimated before packing: enough elements away from the faces. Throws InputError.
void require_enough_inside(Shape shape, const Vec3& size, std::size_t elements);

}  // namespace specimens
