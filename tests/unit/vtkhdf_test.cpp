// VTKHDF files, read back as HDF5: the layout that VTK's reader asks for.
#include "libdem/io/vtkhdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"

using dem::Hdf5File;
using dem::VtkCell;
using dem::VtkGrid;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class Vtkhdf : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      (std::string("spall-vtkhdf-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "." +
       std::to_string(::getpid()));
  std::filesystem::path file = folder / "grid.h5";

  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Two points, a line between them, and each point a cell of its own.
  static VtkGrid small_grid() {
    VtkGrid grid;
    grid.add_point(0, 1, 2);
    grid.add_point(3, 4, 5);
    grid.add_cell(VtkCell::line, {0, 1});
    grid.add_vertices();
    grid.point_data = {{"displacement", 3, std::vector<double>{1, 2, 3, 4, 5, 6}},
                       {"coordination", 1, std::vector<std::int32_t>{7, 8}}};
    grid.cell_data = {{"state", 1, std::vector<std::uint8_t>{2, 0, 1}}};
    return grid;
  }
  std::string refusal(const VtkGrid& grid) const {
    try {
      write_vtkhdf(file, grid);
    } catch (const dem::RunError& error) {
      EXPECT_FALSE(std::filesystem::exists(file));
      return error.what();
    }
    return "accepted";
  }
};

}  // namespace

TEST_F(Vtkhdf, HasTheLayoutOfVersion1) {
  write_vtkhdf(file, small_grid());
  const Hdf5File in = Hdf5File::open(file);
  EXPECT_THAT(in.numbers_attribute<std::int64_t>("VTKHDF", "Version"), ElementsAre(1, 0));
  EXPECT_EQ(in.text_attribute("VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/NumberOfPoints"), ElementsAre(2));
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/NumberOfCells"), ElementsAre(3));
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/NumberOfConnectivityIds"), ElementsAre(4));
  EXPECT_THAT(in.read<double>("VTKHDF/Points", 3), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/Connectivity"), ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/Offsets"), ElementsAre(0, 2, 3, 4));
  EXPECT_THAT(in.read<std::uint8_t>("VTKHDF/Types"), ElementsAre(3, 1, 1));
  EXPECT_THAT(in.names_in("VTKHDF/PointData"), ElementsAre("coordination", "displacement"));
  EXPECT_THAT(in.read<double>("VTKHDF/PointData/displacement", 3), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(in.read<std::int32_t>("VTKHDF/PointData/coordination"), ElementsAre(7, 8));
  EXPECT_THAT(in.read<std::uint8_t>("VTKHDF/CellData/state"), ElementsAre(2, 0, 1));
}

TEST_F(Vtkhdf, KeepsVtksOrderOfAHexahedron) {
  VtkGrid grid;
  for (int k = 0; k < 8; ++k) grid.add_point(k & 1, (k >> 1) & 1, k >> 2);
  grid.add_cell(VtkCell::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6});
  write_vtkhdf(file, grid);
  const Hdf5File in = Hdf5File::open(file);
  EXPECT_THAT(in.read<std::int64_t>("VTKHDF/Connectivity"), ElementsAre(0, 1, 3, 2, 4, 5, 7, 6));
  EXPECT_THAT(in.read<std::uint8_t>("VTKHDF/Types"), ElementsAre(12));
  EXPECT_THAT(in.names_in("VTKHDF/CellData"), testing::IsEmpty());
}

TEST_F(Vtkhdf, AGridThatIsNotWholeIsRefusedAndNothingIsWritten) {
  VtkGrid grid = small_grid();
  grid.points.pop_back();
  EXPECT_THAT(refusal(grid), HasSubstr("threes"));
  grid = small_grid();
  grid.add_cell(VtkCell::vertex, {2});
  EXPECT_THAT(refusal(grid), HasSubstr("names point 2 of 2"));
  grid = small_grid();
  grid.types.pop_back();
  EXPECT_THAT(refusal(grid), HasSubstr("add_cell"));
  grid = small_grid();
  grid.cell_data.push_back({"strain", 1, std::vector<double>{1, 2}});
  EXPECT_THAT(refusal(grid), HasSubstr("field strain has values for 2 of 3 cells"));
  grid = small_grid();
  grid.point_data.push_back({"force", 3, std::vector<double>{1, 2, 3, 4}});
  EXPECT_THAT(refusal(grid), HasSubstr("force: 4 values do not make whole rows of 3"));
  for (const char* name : {"", "a/b", ".", "coordination"}) {
    grid = small_grid();
    grid.point_data.push_back({name, 1, std::vector<double>{1, 2}});
    EXPECT_THAT(refusal(grid), HasSubstr("cannot name a field")) << name;
  }
}
