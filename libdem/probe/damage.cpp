#include "libdem/probe/damage.h"

namespace dem {

std::size_t broken_links(const LinkLaw& law, const Links& links) {
  std::size_t broken = 0;
  for (std::size_t k = 0; k < links.count; ++k) broken += law.is_broken(links.max_strain[k]) ? 1 : 0;
  return broken;
}

std::size_t softening_links(const LinkLaw& law, const Links& links) {
  std::size_t begun = 0;
  for (std::size_t k = 0; k < links.count; ++k) begun += links.max_strain[k] > law.yield_strain() ? 1 : 0;
  return begun - broken_links(law, links);
}

std::vector<double> element_damage(const LinkLaw& law, const Links& links, std::size_t elements) {
  std::vector<double> initial(elements, 0), broken(elements, 0);
  for (std::size_t k = 0; k < links.count; ++k)
    for (const std::int32_t i : {links.a[k], links.b[k]}) {
      initial[static_cast<std::size_t>(i)] += 1;
      if (law.is_broken(links.max_strain[k])) broken[static_cast<std::size_t>(i)] += 1;
    }
  for (std::size_t i = 0; i < elements; ++i) broken[i] = initial[i] > 0 ? broken[i] / initial[i] : 0;
  return broken;
}

}  // namespace dem
