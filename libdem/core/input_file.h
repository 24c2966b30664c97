// A file that a job was made from, as it was when it was read.
#pragma once
#include <filesystem>
#include <string>

namespace dem {

struct InputFile {
  std::string what;  ///< its part in the job: "case", "card", "mesh"
  std::filesystem::path file;
  std::string sha256;  ///< of what was read, whatever has become of the file since
};

}  // namespace dem
