#include "study/claims.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "libdem/core/error.h"

namespace study {
namespace {

struct flock byte_of(std::string_view key, short type) {
  unsigned long long place = 0;
  // Fifteen digits, 60 bits: a positive offset everywhere. Two keys that share them only wait for each other.
  const std::string_view digits = key.substr(0, 15);
  std::from_chars(digits.data(), digits.data() + digits.size(), place, 16);
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(place);
  lock.l_len = 1;
  return lock;
}

bool held_by_another(int descriptor, std::string_view key) {
  struct flock lock = byte_of(key, F_RDLCK);
  return ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}  // namespace

Claims::Claims(const std::filesystem::path& file) {
  descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw dem::RunError(fmt::format("{}: cannot open ({})", file.string(), std::strerror(errno)));
}

Claims::~Claims() { ::close(descriptor); }

bool Claims::take(std::string_view key) {
  struct flock lock = byte_of(key, F_WRLCK);
  for (;;) {
    if (::fcntl(descriptor, F_OFD_SETLK, &lock) == 0) return true;
    if (errno != EINTR) return errno != EAGAIN && errno != EACCES;
  }
}

void Claims::release(std::string_view key) {
  struct flock lock = byte_of(key, F_UNLCK);
  ::fcntl(descriptor, F_OFD_SETLK, &lock);
}

bool Claims::held_elsewhere(std::string_view key) const { return held_by_another(descriptor, key); }

bool Claims::held(const std::filesystem::path& file, std::string_view key) {
  const int looking = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (looking < 0) return false;
  const bool found = held_by_another(looking, key);
  ::close(looking);
  return found;
}

}  // namespace study
