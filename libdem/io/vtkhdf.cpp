#include "libdem/io/vtkhdf.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"

namespace dem {
namespace {

void require_whole(const std::filesystem::path& file, const VtkGrid& grid) {
  const auto refuse = [&](const std::string& what) {
    throw RunError(fmt::format("{}: {}; nothing was written", file.string(), what));
  };
  if (grid.points.size() % 3 != 0) refuse("the points' coordinates do not come in threes");
  if (grid.offsets.size() != grid.types.size() + 1 || grid.offsets.front() != 0 ||
      grid.offsets.back() != static_cast<std::int64_t>(grid.connectivity.size()))
    refuse("the cells' offsets do not fit the cells; use add_cell");
  for (const std::int64_t point : grid.connectivity)
    if (point < 0 || point >= static_cast<std::int64_t>(grid.point_count()))
      refuse(fmt::format("a cell names point {} of {}", point, grid.point_count()));
  const auto check_fields = [&](const std::vector<VtkField>& fields, const char* of, std::size_t count) {
    std::set<std::string> names;
    for (const VtkField& field : fields) {
      if (field.name.empty() || field.name.find_first_of("/.") != std::string::npos ||
          !names.insert(field.name).second)
        refuse(fmt::format("\"{}\" cannot name a field of the {}", field.name, of));
      if (field.rows() != count)
        refuse(fmt::format("field {} has values for {} of {} {}", field.name, field.rows(), count, of));
    }
  };
  check_fields(grid.point_data, "points", grid.point_count());
  check_fields(grid.cell_data, "cells", grid.cell_count());
}

void write_fields(Hdf5File& out, const std::string& group, const std::vector<VtkField>& fields,
                  const Hdf5Storage& storage) {
  out.make_group(group);
  for (const VtkField& field : fields)
    std::visit(
        [&](const auto& values) {
          out.write(group + "/" + field.name, values, field.components > 1 ? field.components : 0, storage);
        },
        field.values);
}

}  // namespace

std::size_t VtkField::rows() const {
  const std::size_t count = std::visit([](const auto& column) { return column.size(); }, values);
  if (components == 0 || count % components != 0)
    throw RunError(fmt::format("field {}: {} values do not make whole rows of {}", name, count, components));
  return count / components;
}

void VtkGrid::add_cell(VtkCell type, std::span<const std::int64_t> its_points) {
  connectivity.insert(connectivity.end(), its_points.begin(), its_points.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  types.push_back(static_cast<std::uint8_t>(type));
}

void VtkGrid::add_vertices() {
  for (std::size_t point = 0; point < point_count(); ++point)
    add_cell(VtkCell::vertex, {static_cast<std::int64_t>(point)});
}

void write_vtkhdf(const std::filesystem::path& file, const VtkGrid& grid, int gzip) {
  require_whole(file, grid);
  write_file_atomically(file, [&](const std::filesystem::path& part) {
    Hdf5File out = Hdf5File::create(part);
    out.make_group("VTKHDF");
    constexpr std::array<std::int64_t, 2> version{1, 0};
    out.set_attribute("VTKHDF", "Version", std::span<const std::int64_t>(version));
    out.set_attribute("VTKHDF", "Type", "UnstructuredGrid");
    // One part of a grid that may be in many: every number is a list of one.
    const auto write_number = [&](const char* name, std::size_t value) {
      out.write(fmt::format("VTKHDF/{}", name), std::vector{static_cast<std::int64_t>(value)});
    };
    write_number("NumberOfPoints", grid.point_count());
    write_number("NumberOfCells", grid.cell_count());
    write_number("NumberOfConnectivityIds", grid.connectivity.size());
    const Hdf5Storage storage{.gzip = gzip};
    out.write("VTKHDF/Points", grid.points, 3, storage);
    out.write("VTKHDF/Connectivity", grid.connectivity, 0, storage);
    out.write("VTKHDF/Offsets", grid.offsets, 0, storage);
    out.write("VTKHDF/Types", grid.types, 0, storage);
    write_fields(out, "VTKHDF/PointData", grid.point_data, storage);
    write_fields(out, "VTKHDF/CellData", grid.cell_data, storage);
    out.close();
  });
}

}  // namespace dem
