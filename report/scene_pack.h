// A Scene on its way into a page: quantised, laid out so that it compresses, deflated.
// report/web/src/space/unpack.ts is the other side.
//
// A number v becomes the integer nearest to (v - low) / quantum, so what is drawn is within half a quantum of
// what was computed. A frame's integers are taken as differences from the frame before, an index list's and the
// centres' as differences from the entry before; differences d are written as 2 d or -2 d - 1 (so that small
// ones of either sign are small) in bytes of one rank after another. The order, all counts being in the header:
//
//   centres         3 columns of uint16, differences along the elements
//   radii           uint8
//   mesh nodes      3 columns of uint16, differences along the nodes
//   mesh faces      uint32, differences
//   body triangles  uint32, differences
//   broken links    first, second, frame: 3 columns of uint32, differences
//   each frame      displacements 3 columns of int16, then one column of uint8 a field, then displacements of
//   the
//                   nodes (int16) and points of the body (uint16), 3 columns each: all differences from the
//                   frame before, the first from zero
#pragma once
#include <array>
#include <cstddef>
#include <string>

#include "report/scene.h"

namespace report {

/// The code of a value that is not a number; numbers take 0 to 254.
inline constexpr int no_value = 255;

struct PackedScene {
  std::string header;         ///< JSON that may stand inside a <script> element
  std::string data;           ///< deflated (zlib, RFC 1950)
  std::size_t raw_bytes = 0;  ///< of the data before deflation
};

/// Throws std::invalid_argument, naming the scene and what is wrong, if lengths or indices do not fit together
/// or if a position is not finite.
PackedScene pack(const Scene& scene);

/// RFC 4648, with padding, no line breaks.
std::string base64(const std::string& bytes);

}  // namespace report
