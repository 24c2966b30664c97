// SHA-256 of memory and files (OpenSSL), for provenance and for "same input, same bits".
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace dem {

/// Feeds bytes piece by piece; `hex()` ends it and returns 64 hexadecimal digits.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  Sha256& add(const void* data, std::size_t bytes);
  template <class T>
  Sha256& add(std::span<const T> values) {
    return add(values.data(), values.size_bytes());
  }
  std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context;
};

std::string sha256_of(const std::string& text);
/// Throws InputError if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace dem
