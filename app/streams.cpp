#include "app/streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "libdem/core/error.h"

namespace app {
namespace {

int why_lost = 0;  // errno of what first failed on standard output

void note_loss(const std::FILE* stream) noexcept {
  if (stream == stdout && why_lost == 0) why_lost = errno != 0 ? errno : EIO;
}

}  // namespace

void prepare_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number is free, so it gets that one. What is written to a closed output is lost, and said to
    // be.
    ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void put(std::FILE* stream, std::string_view text) noexcept {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size()) note_loss(stream);
}

void require_output_whole() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) note_loss(stdout);
  if (why_lost != 0)
    throw dem::RunError(fmt::format("standard output cannot be written ({})", std::strerror(why_lost)));
}

}  // namespace app
