// Fields in the format that ParaView opens as it is: VTKHDF 1.0, an unstructured grid of points, cells and
// named data.
#pragma once
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace dem {

/// VTK's cell types that Spall uses, with VTK's numbers and VTK's order of points.
enum class VtkCell : std::uint8_t { vertex = 1, line = 3, triangle = 5, quadrilateral = 9, hexahedron = 12 };

/// Values of one point or one cell after the other, `components` each: 1 for a scalar, 3 for a vector. Names
/// must be unique within points and within cells, not empty, and hold neither '/' nor '.'.
struct VtkField {
  std::string name;
  std::size_t components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>> values;

  /// Number of points or cells that the values are for. Throws RunError if they make no whole rows.
  std::size_t rows() const;
};

/// An unstructured grid.
struct VtkGrid {
  std::vector<double> points;              ///< x, y, z of each point [m]
  std::vector<std::int64_t> connectivity;  ///< point numbers of the cells, one cell after the other
  std::vector<std::int64_t> offsets{0};    ///< where each cell begins in `connectivity`, and the end
  std::vector<std::uint8_t> types;         ///< VtkCell of each cell
  std::vector<VtkField> point_data, cell_data;

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return types.size(); }
  void add_point(double x, double y, double z) { points.insert(points.end(), {x, y, z}); }
  void add_cell(VtkCell type, std::span<const std::int64_t> its_points);
  void add_cell(VtkCell type, std::initializer_list<std::int64_t> its_points) {
    add_cell(type, std::span<const std::int64_t>(its_points.begin(), its_points.size()));
  }
  /// Makes every point a cell of its own, so that ParaView draws points that no other cell uses.
  void add_vertices();
};

/// Writes the grid (group /VTKHDF) whole or not at all. Throws RunError if it cannot be written, or if the
/// grid is not whole: a cell that names a point that is not there, a field of the wrong length, a name that is
/// not allowed. `gzip`: 0 (as it is) to 9, see Hdf5Storage.
void write_vtkhdf(const std::filesystem::path& file, const VtkGrid& grid, int gzip = 0);

}  // namespace dem
