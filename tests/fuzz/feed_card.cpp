#include "libdem/material/material_card.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::card(std::string_view bytes) {
  read_as_file("card.toml", bytes, [](const auto& file) { dem::to_toml(dem::read_card(file)); });
}
