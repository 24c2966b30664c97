// Pictures of a run for ParaView: VTKHDF files numbered by frame, and for each kind an index with the times.
#pragma once
#include <filesystem>

#include "impact/impact_run.h"
#include "impact/impactor_surface.h"
#include "impact/scene.h"
#include "libdem/io/frame_series.h"

namespace impact {

/// Writes frames as they come, as dem::FrameSeries does. The kinds:
///   elements         points with radius, damage (broken over initial links), displacement, velocity, fragment
///                    (0 is the main body)
///   links            lines with state (0 whole, 1 softening, 2 broken) and strain
///   finite_elements  hexahedra with displacement and velocity; coupled only
///   impactor         triangles
/// Everything is drawn where it is, not where it was: displacements are data beside.
class FrameWriter {
 public:
  /// Makes the folder. With `resume` the frames that it holds stay in the indexes; else they are removed.
  /// Throws RunError.
  FrameWriter(const Scene& scene, std::filesystem::path folder, bool resume);

  /// Writes the frame's files, whole or not at all, then the indexes. A frame that is there already is
  /// replaced. Throws RunError.
  void write(const Frame& frame);

  std::size_t count() const { return series.count(); }

 private:
  dem::FrameSeries series;
  Surface impactor;  ///< empty without one
};

}  // namespace impact
