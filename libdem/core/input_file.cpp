#include "libdem/core/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "libdem/core/error.h"

namespace dem {

std::string content_of_input(const std::filesystem::path& file, std::size_t most, const std::string& remedy) {
  const std::string name = file.string();
  const auto refuse = [&](const std::string& wrong) { throw InputError(name, wrong, remedy); };
  const auto cannot_be_read = [&](int reason) {
    refuse(fmt::format("the file cannot be read ({})", std::strerror(reason)));
  };
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(file, error).type();
  if (type == std::filesystem::file_type::not_found) refuse("there is no such file");
  if (type == std::filesystem::file_type::directory) refuse("the file cannot be read: it is a folder");
  if (type == std::filesystem::file_type::character || type == std::filesystem::file_type::block)
    refuse("the file cannot be read: it is a device");
  if (error) cannot_be_read(error.value());
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) cannot_be_read(errno);
  std::string content;
  std::array<char, 65536> part{};
  ssize_t got = 0;
  do {
    got = ::read(descriptor, part.data(), part.size());
    if (got > 0) content.append(part.data(), static_cast<std::size_t>(got));
  } while (content.size() <= most && (got > 0 || (got < 0 && errno == EINTR)));
  const int reason = errno;
  ::close(descriptor);
  if (got < 0) cannot_be_read(reason);
  if (content.size() > most) refuse(fmt::format("the file is larger than {} MB", most >> 20));
  return content;
}

}  // namespace dem
