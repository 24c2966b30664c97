// Input files: read whole, since anything may be wrong with them, and remembered as they were then.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace dem {

/// A file that a job was made from, as it was when it was read.
struct InputFile {
  std::string what;  ///< its part in the job: "case", "card", "mesh"
  std::filesystem::path file;
  std::string sha256;  ///< of what was read, whatever has become of the file since
};

/// The bytes of a file, or of a pipe. Throws InputError if there is none, it is a folder or a device, it cannot
/// be read, or it holds more than `most` bytes; `remedy` says what to give instead.
std::string content_of_input(const std::filesystem::path& file, std::size_t most, const std::string& remedy);

}  // namespace dem
