// The feed of feed_gmsh.cpp, with one process of Gmsh's library for many meshes: to copy a process under the
// address sanitizer takes ten milliseconds, to read a small mesh a tenth of one.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>

#include "impact/fe/gmsh_library.h"
#include "impact/fe/gmsh_mesh.h"
#include "libdem/core/child_process.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/gmsh_server.h"
#include "tests/fuzz/scratch_folder.h"

namespace {

/// The fuzzer's alarm, which looks for what takes too long, breaks in on what waits.
template <class Call>
ssize_t uninterrupted(Call call) {
  ssize_t result = 0;
  do {
    result = call();
  } while (result < 0 && errno == EINTR);
  return result;
}

class Server {
 public:
  explicit Server(const std::string& mesh) : found(::memfd_create("found", MFD_CLOEXEC)) {
    if (found < 0 || ::pipe2(requests.data(), O_CLOEXEC) != 0 || ::pipe2(answers.data(), O_CLOEXEC) != 0)
      std::abort();
    dem::start_child([&] {
      ::dup2(requests[0], gmsh_server::requests);
      ::dup2(answers[1], gmsh_server::answers);
      ::dup2(found, gmsh_server::found);
      ::execl(SPALL_GMSH_SERVER, SPALL_GMSH_SERVER, mesh.c_str(), nullptr);
    });
    ::close(requests[0]);
    ::close(answers[1]);
  }

  /// What the library found in the mesh; cut short if it failed or crashed.
  std::string read() {
    char answer = 0;
    if (uninterrupted([&] { return ::write(requests[1], &answer, 1); }) != 1 ||
        uninterrupted([&] { return ::read(answers[0], &answer, 1); }) != 1)
      std::abort();
    const off_t size = ::lseek(found, 0, SEEK_END);
    std::string sent(static_cast<std::size_t>(size), '\0');
    if (::pread(found, sent.data(), sent.size(), 0) != size) std::abort();
    if (answer != gmsh_server::whole) sent.resize(sent.size() / 2);
    return sent;
  }

 private:
  int found;
  std::array<int, 2> requests{}, answers{};
};

}  // namespace

void fuzz::gmsh(std::string_view bytes) {
  static const std::string name = (scratch_folder() / "slab.msh").string();
  static Server server(name);
  if (!bytes.starts_with('$')) return;  // refused before Gmsh sees it
  std::ofstream(name, std::ios::binary) << bytes;
  take_refusal([&] { fe::mesh_of(fe::gmsh_content(server.read(), name), name, 0.001); });
}
