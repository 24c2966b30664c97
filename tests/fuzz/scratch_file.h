// A file in memory that a reader opens by its name.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "libdem/core/error.h"

namespace fuzz {

/// A folder of this process in memory (/dev/shm) where there is one, with the files of tests/cli/bad_input/base
/// that cases name. Removed when the process ends.
inline const std::filesystem::path& scratch_folder() {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      namespace fs = std::filesystem;
      const fs::path memory = "/dev/shm";
      path = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
             ("spall-fuzz-" + std::to_string(::getpid()));
      fs::remove_all(path);
      fs::copy(fs::path(SPALL_SOURCE_DIR) / "tests/cli/bad_input/base", path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

/// Writes `bytes` to the file of this name there, and lets `read` read it.
template <class Read>
void read_as_file(const char* name, std::string_view bytes, Read&& read) {
  const std::filesystem::path file = scratch_folder() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    read(file);
  } catch (const dem::InputError&) {
  } catch (const dem::RunError&) {
  }
}

}  // namespace fuzz
