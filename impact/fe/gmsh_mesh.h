// Meshes made by Gmsh: any .msh of eight-node hexahedra.
#pragma once
#include <string>

#include "impact/fe/gmsh_library.h"
#include "impact/fe/mesh.h"

namespace fe {

/// Reads and checks a .msh file (any version that the Gmsh library reads). `unit` is the length of the file's
/// unit [m]. Physical groups become node groups by their name, or "dimension:tag" where they have none. Throws
/// InputError if the file cannot be read, holds a three-dimensional element other than the eight-node
/// hexahedron, or fails `check`; RunError if the Gmsh library is missing on this machine.
Mesh read_gmsh(const std::string& file, double unit = 1);

/// The same from what the library found in it.
Mesh mesh_of(const GmshContent& content, const std::string& file, double unit);

}  // namespace fe
