// A scene as a still picture: shaded spheres coloured by a field, the mesh's edges, the body, a colour bar and
// a scale bar.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture_png.h"
#include "report/scene.h"

namespace report {

/// Where the viewer stands: on the x axis, before the x-z plane, above, or aslant.
enum class View { iso, x, y, z };
/// The names that an input may give, in the order of View.
const std::vector<std::string>& view_names();

/// Takes away what lies between the viewer and the plane where this coordinate has this value [m]. A plane
/// along the line of sight takes the side of larger coordinates.
struct SceneCut {
  int axis = 0;
  double at = 0;
};

struct ScenePictureOptions {
  double width = 160;          ///< of the picture [mm]
  double dots_per_inch = 200;  ///< its pixels
  View view = View::iso;
  std::optional<std::size_t> frame = std::nullopt;  ///< index into Scene::frames; the last without it
  std::size_t field = 0;                            ///< index into Scene::fields
  std::optional<SceneCut> cut = std::nullopt;
};

/// Pixels of the drawing, and the SVG with the words that goes on top.
struct ScenePicture {
  Image image;
  std::string words;
  /// Pixels a metre, and where the point (0, 0, 0) is in the picture: for whoever wants to find something in
  /// it.
  double scale = 0, origin_x = 0, origin_y = 0;
};

/// Draws it. Same input, same bits. Throws std::invalid_argument if the frame or the field is not there.
ScenePicture scene_picture(const Scene& scene, const ScenePictureOptions& options);

}  // namespace report
