// Files with a SHA-256 of their content, past the check of it.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "libdem/io/content.h"
#include "tests/fuzz/scratch_folder.h"

namespace fuzz {

/// Lets `read` read the file that `bytes` are. If it is refused for its sum alone, as any change of a value is
/// (the fuzzers' build does not insist on it), the right sum is put in the place of the wrong one and the file
/// read once more: what is behind the check is reached.
template <class Read>
void read_sealed(std::string_view bytes, const char* name, Read&& read) {
  std::optional<dem::WrongSum> wrong;
  take_refusal([&] {
    try {
      read(dem::Hdf5File::open_image(bytes, name));
    } catch (const dem::WrongSum& refusal) {
      wrong = refusal;
    }
  });
  if (!wrong || wrong->named.size() != wrong->found.size()) return;
  const auto at = bytes.find(wrong->named);
  if (at == std::string_view::npos) return;
  std::string sealed(bytes);
  sealed.replace(at, wrong->found.size(), wrong->found);
  take_refusal([&] { read(dem::Hdf5File::open_image(sealed, name)); });
}

}  // namespace fuzz
