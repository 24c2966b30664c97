// HDF5 files that are not what they should be, by the name of what is wrong with them.
#pragma once
#include <filesystem>
#include <string>

namespace cli {

/// Writes the file of that damage; "whole" is a sound specimen of a thousand elements in 0.3 x 0.2 x 0.2 m.
/// Throws std::out_of_range if no damage has this name. May be called from several threads.
void make_damaged(const std::string& damage, const std::filesystem::path& file);

}  // namespace cli
