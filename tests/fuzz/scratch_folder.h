// What every feed uses: refusals are taken, and files that a text may name are there.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

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

/// What a reader may say of a wrong file is no finding.
template <class Read>
void take_refusal(Read&& read) {
  try {
    read();
  } catch (const dem::InputError&) {
  } catch (const dem::RunError&) {
  }
}

}  // namespace fuzz
