// Datasets with the SHA-256 of what they hold: a file that a run goes on from is refused if a bit has changed.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "libdem/io/hdf5.h"

namespace dem {

/// The content of a file does not have the SHA-256 that the file names.
class WrongSum : public InputError {
 public:
  WrongSum(const std::filesystem::path& file, std::string named_sum, std::string found_sum)
      : InputError(file.string(), "is damaged: its content does not have the SHA-256 that it names",
                   "start anew without --resume"),
        named(std::move(named_sum)),
        found(std::move(found_sum)) {}
  std::string named, found;
};

/// Writes columns and hashes them on the way, names and lengths too; `seal` then sets the root's attribute
/// sha256.
class ContentWriter {
 public:
  /// Names are relative to `group` ("" or "tests/").
  explicit ContentWriter(Hdf5File& out, std::string group_of_all = {})
      : file(out), group(std::move(group_of_all)) {}
  template <class T>
  void put(const std::string& name, const T* values, std::size_t count) {
    file.write(group + name, std::span<const T>(values, count));
    const std::uint64_t length = count;
    hash.add(name.data(), name.size()).add(&length, sizeof length).add(values, count * sizeof(T));
  }
  template <class Values>
  void put(const std::string& name, const Values& values) {
    put(name, values.data(), values.size());
  }
  void seal() { file.set_attribute("/", "sha256", hash.hex()); }

 private:
  Hdf5File& file;
  std::string group;
  Sha256 hash;
};

/// Reads the same columns in the same order, and hashes them alike. Throws InputError as Hdf5File does.
class ContentReader {
 public:
  explicit ContentReader(const Hdf5File& in, std::string group_of_all = {})
      : file(in), group(std::move(group_of_all)) {}
  template <class T>
  std::vector<T> get(const std::string& name, std::size_t length = Hdf5File::any) {
    std::vector<T> values = file.read<T>(group + name, 0, length);
    const std::uint64_t count = values.size();
    hash.add(name.data(), name.size()).add(&count, sizeof count).add(values.data(), count * sizeof(T));
    return values;
  }
  /// Throws WrongSum if what was read is not what was sealed. Call it before the values are believed.
  void require_seal();

 private:
  const Hdf5File& file;
  std::string group;
  Sha256 hash;
};

}  // namespace dem
