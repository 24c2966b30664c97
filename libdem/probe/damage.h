// Damage: the ratio of broken to initial links, of an element or of the whole.
#pragma once
#include <vector>

#include "libdem/law/cohesive_link.h"
#include "libdem/state/links.h"
#include "libdem/state/particles.h"

namespace dem {

/// Number of broken links.
std::size_t broken_links(const LinkLaw& law, const Links& links);
/// Number of links that have begun to soften and are not yet broken.
std::size_t softening_links(const LinkLaw& law, const Links& links);
/// Broken/initial links of each element, 0 to 1; 0 for an element without links.
std::vector<double> element_damage(const LinkLaw& law, const Links& links, std::size_t elements);

}  // namespace dem
