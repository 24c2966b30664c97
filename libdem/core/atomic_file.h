// Files appear whole or not at all: written aside, flushed to the disk, then renamed into place.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace dem {

/// Creates the folder (and its parents) if needed and checks that files can be written in it. Throws RunError
/// if not.
void require_writable_folder(const std::filesystem::path& folder);

/// Creates the folder of `file` (and its parents) if needed and checks that a file of that name can be written
/// there; `by_a_library`: in the second way below. Throws RunError if not.
void require_writable_file(const std::filesystem::path& file, bool by_a_library = false);

/// Writes `content` to `file` atomically, to what it leads to if it is a symbolic link, and straight into it
/// if it is a device or a pipe. Throws RunError that names the file and the system's reason.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// Lets `write` produce a temporary file beside `file` (for libraries that write files themselves), then
/// flushes and renames it. The temporary file is removed if `write` throws. Devices and pipes are refused.
void write_file_atomically(const std::filesystem::path& file,
                           const std::function<void(const std::filesystem::path&)>& write);

}  // namespace dem
