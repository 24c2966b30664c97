// A run in pictures, for ParaView: VTKHDF files numbered by frame, and for each kind an index with the times.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "libdem/io/vtkhdf.h"

namespace dem {

/// When a frame was taken.
struct FrameMoment {
  double time = 0;         ///< [s]
  std::string label = "";  ///< what a reader calls the moment, beside its time; "" if the time says it all
};

/// Writes frames as they come. A kind is a file a frame, elements_0003.hdf, and an index that ParaView opens as
/// one series over time, elements.hdf.series. The name ends in .hdf because ParaView 5.11 knows VTKHDF by that
/// ending alone.
class FrameSeries {
 public:
  /// Makes the folder. `kinds`: every kind that may come, the first of them in every frame. With `resume` the
  /// frames that the folder holds stay in the indexes; else they are removed. Throws RunError, and InputError
  /// for an index that is none.
  FrameSeries(std::filesystem::path folder, std::vector<std::string> kinds, bool resume);

  /// Writes one file of frame `number`, whole or not at all, in place of one that is there. Throws RunError.
  void write(int number, const FrameMoment& moment, const std::string& kind, const VtkGrid& grid);
  /// Writes the indexes: to be called when all files of a frame are there. Throws RunError.
  void write_indexes() const;

  std::size_t count() const { return moments.at(kinds.front()).size(); }

 private:
  bool is_ours(const std::string& name) const;

  std::filesystem::path folder;
  std::vector<std::string> kinds;
  std::map<std::string, std::map<int, FrameMoment>>
      moments;  ///< of the files that are there, by kind and number
};

/// The files of one kind with their moments, in the order of the index; none if there is no index. Files that
/// are not there are left out. Throws InputError that names the index if it is none.
std::vector<std::pair<std::filesystem::path, FrameMoment>> read_frame_series(
    const std::filesystem::path& folder, const std::string& kind);

}  // namespace dem
