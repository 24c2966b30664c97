// Pictures of a run for ParaView: VTKHDF files numbered by frame, and for each kind an index with the times.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "impact/impact_run.h"
#include "impact/impactor_surface.h"
#include "impact/scene.h"

namespace impact {

/// Writes frames as they come. A kind is a file a frame, elements_0003.hdf, and an index that ParaView opens as
/// one series over time, elements.hdf.series. The name ends in .hdf because ParaView 5.11 knows VTKHDF by that
/// ending alone. The kinds:
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

  std::size_t count() const { return times.size(); }

 private:
  void read_times(const std::filesystem::path& index);
  void write_index(const std::string& kind) const;

  std::filesystem::path folder;
  Surface impactor;             ///< empty without one
  std::map<int, double> times;  ///< of the frames that are there [s], by number
};

}  // namespace impact
