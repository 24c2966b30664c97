#include "libdem/material/element_size_rule.h"

#include <fmt/format.h>

#include <cmath>

#include "libdem/core/error.h"

namespace dem {

MaterialCard for_element_size(const MaterialCard& card, double from, double to) {
  if (!(from > 0) || !(to > 0))
    throw InputError("element size", fmt::format("{:.4g} m and {:.4g} m", from, to),
                     "both must be greater than 0");
  const double ratio = to / from;
  if (!(ratio >= 0.1 && ratio <= 10))
    throw InputError("element size",
                     fmt::format("from {:.4g} m to {:.4g} m is a factor of {:.3g}", from, to, ratio),
                     "the rule was measured over a factor of 3: at most 10 is allowed");
  MaterialCard made = card;
  made.softening = card.softening * std::pow(ratio, -0.25);
  made.tensile_strength = card.tensile_strength * std::pow(ratio, 0.14);
  made.provenance.emplace_back(
      "element_size",
      fmt::format("T and zeta brought from elements of {:.4g} mm to {:.4g} mm", 1e3 * from, 1e3 * to));
  return made;
}

}  // namespace dem
