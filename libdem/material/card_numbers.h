// A card's numbers by their keys in card.toml, for those who vary them.
#pragma once
#include <string_view>

#include "libdem/material/material_card.h"

namespace dem {

/// Sets one number (SI) without any check: call validate() when all are set. Throws InputError if there is no
/// such key, with a suggestion.
void set_number(MaterialCard& card, std::string_view key, double value);

}  // namespace dem
