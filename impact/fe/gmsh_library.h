// The Gmsh library at work on a file that may be damaged.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fe {

/// What a .msh file holds, in the file's own length unit and by its own numbers (tags).
struct GmshContent {
  struct Group {
    std::string name;                    ///< "dimension:tag" where it has none
    std::vector<std::size_t> node_tags;  ///< as often as elements name them
  };
  struct Element {
    std::size_t tag = 0;
    std::string type;  ///< Gmsh's name of it: "Tetrahedron 4"
  };

  std::vector<std::size_t> node_tags;
  std::vector<double> coordinates;  ///< three a node
  std::vector<std::size_t> hexahedron_tags;
  std::vector<std::size_t> corner_tags;  ///< eight a hexahedron
  std::vector<Group> groups;             ///< physical groups
  std::vector<Element> other_solids;     ///< of each other type of three dimensions, the first
};

/// Reads a .msh file with the Gmsh library, in a process of its own: the library crashes on many a damaged
/// file, an element of a node that is not there for one. Throws InputError if it cannot read the file or
/// crashes; RunError if this machine lacks the library, or can start no process.
GmshContent read_by_gmsh(const std::string& file);

/// What that process does: reads the file and writes what it holds to the file descriptor `out`. Throws, or
/// crashes, if Gmsh cannot read it.
void send_by_gmsh(const std::string& file, int out);

/// From what that process sends, which may be anything if it is about to crash. Throws InputError.
GmshContent gmsh_content(std::string_view sent, const std::string& file);

}  // namespace fe
