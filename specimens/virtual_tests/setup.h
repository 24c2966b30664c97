// What every virtual test needs of a specimen before it starts.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/material/material_card.h"
#include "libdem/run/step.h"
#include "libdem/statics/link_network.h"
#include "specimens/specimen.h"

namespace virtual_tests {

/// Elements, links and law of a specimen at rest; element density is scaled to the card's mass per volume.
dem::Assembly make_assembly(const specimens::Specimen& specimen, const dem::MaterialCard& card);

/// The specimen's links as an elastic structure, under the law of `assembly`.
dem::LinkNetwork link_network(const specimens::Specimen& specimen, const dem::Assembly& assembly);

/// The axis to load: `wanted` (0, 1, 2), or the specimen's long axis if it is negative. Throws InputError where
/// the shape does not allow it (a cylinder is loaded along its own axis).
int loading_axis(const specimens::Specimen& specimen, int wanted);

/// Elements at least two element sizes from the sides and four (at most 30% of the length) from the platens:
/// where strain is measured (Fig. 3). Throws InputError if there are fewer than 8.
std::vector<std::int32_t> gauge_elements(const specimens::Specimen& specimen, int axis);

}  // namespace virtual_tests
