#include "libdem/material/card_table.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::card(std::string_view bytes) {
  take_refusal([&] { dem::to_toml(dem::card_of(dem::TomlTable::parse(bytes, "card.toml"))); });
}
