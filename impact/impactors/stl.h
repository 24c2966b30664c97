// STL files, binary and text: the triangles of an impactor.
#pragma once
#include <filesystem>
#include <string_view>

#include "impact/impactors/triangle_mesh.h"

namespace impact {

/// Reads a closed surface. STL has no unit: `metres_per_unit` says what one of the file's units is (0.001 for
/// millimetres). The normals in the file are ignored, the order of the corners counts. Throws InputError that
/// names the file, and the triangle or line, if it cannot be read, is neither form of STL, is truncated, or is
/// no closed, consistently oriented surface.
TriangleMesh read_stl(const std::filesystem::path& file, double metres_per_unit);

/// The same from the bytes of a file; `name` stands for the file in messages.
TriangleMesh parse_stl(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace impact
