// Names for files that are not whole yet, and what becomes of them when their process is killed.
#pragma once
#include <filesystem>

namespace dem {

/// A hidden name beside `file` for what is not whole yet; it names this machine and process.
std::filesystem::path scratch_path(const std::filesystem::path& file);

/// Removes from `folder`, not from those in it, what processes of this machine that have ended left under a
/// `scratch_path`. What belongs to another machine stays: it may be at work. Throws nothing.
void sweep_scratch(const std::filesystem::path& folder);

}  // namespace dem
