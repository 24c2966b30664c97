// A material card from a table of TOML that is already read.
#pragma once
#include "libdem/config/toml_reader.h"
#include "libdem/material/material_card.h"

namespace dem {

/// The card in `table`: what read_card makes of a file. Throws InputError (unknown or missing key, wrong unit,
/// bound violated).
MaterialCard card_of(const TomlTable& table);

}  // namespace dem
