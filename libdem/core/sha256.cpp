#include "libdem/core/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>

#include "libdem/core/error.h"

namespace dem {

struct Sha256::Context {
  EVP_MD_CTX* evp = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(evp); }
};

Sha256::Sha256() : context(std::make_unique<Context>()) {
  if (EVP_DigestInit_ex(context->evp, EVP_sha256(), nullptr) != 1)
    throw RunError("SHA-256 is not available in OpenSSL");
}
Sha256::~Sha256() = default;

Sha256& Sha256::add(const void* data, std::size_t bytes) {
  EVP_DigestUpdate(context->evp, data, bytes);
  return *this;
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_DigestFinal_ex(context->evp, digest.data(), &length);
  std::string text;
  for (unsigned int k = 0; k < length; ++k) text += fmt::format("{:02x}", digest[k]);
  return text;
}

std::string sha256_of(const std::string& text) { return Sha256().add(text.data(), text.size()).hex(); }

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), "cannot be read", "check the path and the permissions");
  Sha256 hash;
  std::array<char, 1 << 16> buffer;
  while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0)
    hash.add(buffer.data(), static_cast<std::size_t>(in.gcount()));
  return hash.hex();
}

}  // namespace dem
