// A card for elements of another size: what keeps tensile strength and fracture energy where they are.
#pragma once
#include "libdem/material/material_card.h"

namespace dem {

/// A finer pack of the same card is stronger in tension; its fracture energy hardly falls, as long as there are
/// some twelve elements across. With zeta and T in proportion to powers of the element size both stay, over a
/// factor of three (docs/validation.md, "Fracture energy"; measured on the law with moments, zeta 6):
///   zeta ~ D^-0.25, T ~ D^0.14.
/// All else stays; the size of an element is (volume / elements)^(1/3) [m]. Throws InputError for sizes that
/// are not positive, or more than a factor of ten apart.
MaterialCard for_element_size(const MaterialCard& card, double from, double to);

}  // namespace dem
