// The case file of an impact.
#pragma once
#include <filesystem>
#include <optional>

#include "impact/scene.h"
#include "libdem/config/toml_reader.h"

namespace impact {

/// Reads and checks case.toml and the files that it names: card, specimen, mesh, STL. docs/cases.md lists the
/// keys. Whatever can be told without packing or running is told here. Throws InputError: one line that names
/// file, line and key, what is wrong and what is allowed. `card` stands in for the card that the case names.
Scene read_scene(const std::filesystem::path& file, const std::optional<std::filesystem::path>& card = {});
/// The same of a table from elsewhere; paths in it are relative to the folder of the file that it names.
Scene scene_of(const dem::TomlTable& root, const std::optional<std::filesystem::path>& card = {});

}  // namespace impact
