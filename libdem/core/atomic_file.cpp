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

/// Something that a rename would put a plain file in place of.
bool is_device_or_pipe(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(file, ignored).type();
  using enum std::filesystem::file_type;
  return type == block || type == character || type == fifo || type == socket;
}

[[noreturn]] void refuse_device_or_pipe(const std::filesystem::path& file) {
  throw RunError(fmt::format("{}: is a device or a pipe; such a file must be a real one", file.string()));
}

/// Where a symbolic link leads, there or not.
std::filesystem::path followed(std::filesystem::path file) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int links = 0; links < most_links && std::filesystem::is_symlink(file, error); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(file, error);
    if (error) break;
    file = file.parent_path() / next;  // which is `next` where that is absolute
  }
  return file;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw RunError(fmt::format("{}: the folder cannot be made ({})", folder.string(), error.message()));
}

bool can_be_made(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return false;
  ::close(descriptor);
  ::unlink(file.c_str());
  return true;
}

/// Messages name `file`.
void write_content(const std::filesystem::path& into, std::string_view content,
                   const std::filesystem::path& file) {
  const int descriptor = ::open(into.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0644);
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
}

void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file) {
  flush_to_disk(part, O_RDONLY);
  if (::rename(part.c_str(), file.c_str()) != 0) fail(file, "rename into place");
  flush_to_disk(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY);
}

}  // namespace

void require_writable_folder(const std::filesystem::path& folder) {
  make_folder(folder);
  const std::filesystem::path probe = scratch_path(folder / "probe");
  if (!can_be_made(probe)) fail(folder, "write in this folder");
}

void require_writable_file(const std::filesystem::path& file, bool by_a_library) {
  if (is_device_or_pipe(file)) return by_a_library ? refuse_device_or_pipe(file) : void();
  const std::filesystem::path target = followed(file);
  make_folder(target.has_parent_path() ? target.parent_path() : ".");
  if (!can_be_made(scratch_path(target))) fail(file, "write");
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  if (is_device_or_pipe(file)) return write_content(file, content, file);
  write_file_atomically(file, [&](const std::filesystem::path& part) { write_content(part, content, file); });
}

void write_file_atomically(const std::filesystem::path& file,
                           const std::function<void(const std::filesystem::path&)>& write) {
  if (is_device_or_pipe(file)) refuse_device_or_pipe(file);
  const std::filesystem::path target = followed(file), part = scratch_path(target);
  const auto remove_part = [&] {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  };
  try {
    write(part);
    put_in_place(part, target);
  } catch (const RunError& error) {
    remove_part();
    // The hidden name says nothing to whoever reads it.
    std::string message = error.what();
    if (const auto at = message.find(part.string()); at != std::string::npos)
      message.replace(at, part.string().size(), file.string());
    throw RunError(message);
  } catch (...) {
    remove_part();
    throw;
  }
}

}  // namespace dem
