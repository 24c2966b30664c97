// Reads meshes with Gmsh's library for feed_gmsh_kept_alive.cpp, which starts it: gmsh_server <file>. For each
// letter that comes through the one pipe a reader reads <file>, leaves what it found in a file in memory and
// answers through the other. When a reader crashes, the server says so and starts another: without sanitizers
// that takes a millisecond, under them ten.
#include <unistd.h>

#include "impact/fe/gmsh_library.h"
#include "libdem/core/child_process.h"
#include "tests/fuzz/gmsh_server.h"

namespace {

using namespace gmsh_server;

void reply(char answer) {
  if (::write(answers, &answer, 1) != 1) ::_exit(1);
}

void read_meshes(const std::string& file) {
  constexpr int for_a_while = 20'000;
  char request = 0;
  for (int served = 0; served < for_a_while; ++served) {
    if (::read(requests, &request, 1) != 1 || ::ftruncate(found, 0) != 0) ::_exit(1);
    ::lseek(found, 0, SEEK_SET);
    char answer = whole;
    try {
      fe::send_by_gmsh(file, found);
    } catch (...) {
      answer = failed;
    }
    reply(answer);
  }
}

}  // namespace

int main(int, char** arguments) {
  try {
    fe::send_by_gmsh("/nothing.msh", found);
  } catch (...) {  // the library is loaded now, once
  }
  constexpr dem::ChildLimits limits{std::uint64_t{1} << 30, 20};
  for (;;)
    if (!dem::wait_for_child(dem::start_child([&] { read_meshes(arguments[1]); }, limits)).succeeded)
      reply(crashed);
}
