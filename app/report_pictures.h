// The charts and scenes of a run's page as files: for papers, and for machines that look at results.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/page.h"
#include "report/picture_scene.h"

namespace app {

/// What was asked for, as it was typed; empty where nothing was.
struct PictureRequest {
  bool png = false;
  bool svg = false;
  std::string width = "160 mm";
  double dots_per_inch = 200;
  std::string view = "iso";
  std::string frame = "last";  ///< or a number from 1
  std::string field;           ///< of the elements; without it the first, damage
  std::string cut;             ///< "y=0.1 m"

  /// Throws InputError that names the option, for what can be wrong whatever the page holds.
  void check() const;
};

/// Draws them into `folder`, which is made if it is not there, numbered in the page's order. Returns the files.
/// Throws InputError (no such field or frame, nothing to draw) before anything is written, RunError if a file
/// cannot be written.
std::vector<std::filesystem::path> draw_pictures(const report::Page& page, const PictureRequest& request,
                                                 const std::filesystem::path& folder);

}  // namespace app
