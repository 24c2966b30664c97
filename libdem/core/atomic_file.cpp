#include "libdem/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "libdem/core/error.h"
#include "libdem/core/scratch_files.h"

namespace dem {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
  throw RunError(fmt::format("{}: cannot {} ({})", path.string(), action, std::strerror(errno)));
}

void flush_to_disk(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags);
  if (descriptor < 0) fail(path, "open for flushing");
  const int result = ::fsync(descriptor);
  ::close(descriptor);
  if (result != 0) fail(path, "flush to the disk");
}

void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file) {
  flush_to_disk(part, O_RDONLY);
  if (::rename(part.c_str(), file.c_str()) != 0) fail(file, "rename into place");
  flush_to_disk(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY);
}

}  // namespace

void require_writable_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw RunError(fmt::format("{}: the folder cannot be made ({})", folder.string(), error.message()));
  const std::filesystem::path probe = scratch_path(folder / "probe");
  const int descriptor = ::open(probe.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
  if (descriptor < 0) fail(folder, "write in this folder");
  ::close(descriptor);
  ::unlink(probe.c_str());
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  write_file_atomically(file, [&](const std::filesystem::path& part) {
    const int descriptor = ::open(part.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    if (descriptor < 0) fail(file, "write");
    for (std::size_t done = 0; done < content.size();) {
      const ssize_t written = ::write(descriptor, content.data() + done, content.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        const int reason = errno;
        ::close(descriptor);
        errno = reason;
        fail(file, "write");
      }
      done += static_cast<std::size_t>(written);
    }
    if (::close(descriptor) != 0) fail(file, "close");
  });
}

void write_file_atomically(const std::filesystem::path& file,
                           const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path part = scratch_path(file);
  try {
    write(part);
    put_in_place(part, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace dem
