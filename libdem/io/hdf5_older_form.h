// HDF5 files of the older form, whose records have no checksums.
#pragma once
#include <filesystem>

namespace dem {

/// Whether HDF5's library can be trusted with the file: HDF5 1.10 believes the lengths in the headers of the
/// form that was usual before 1.8 and that other programs still write, and can crash where they are damaged.
/// Files of that form are first read whole by a child of this process. True for all others. Call it under the
/// library's lock. Throws RunError if no process can be started.
bool survives_older_form(const std::filesystem::path& file);

}  // namespace dem
