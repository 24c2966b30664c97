// Whole input files, of which anything may be wrong.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace dem {

/// The bytes of a file, or of a pipe. Throws InputError if there is none, it is a folder or a device, it cannot
/// be read, or it holds more than `most` bytes; `remedy` says what to give instead.
std::string content_of_input(const std::filesystem::path& file, std::size_t most, const std::string& remedy);

}  // namespace dem
