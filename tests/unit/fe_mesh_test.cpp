// Meshes: structured ones, those that Gmsh wrote, what is refused, and finding points in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "impact/fe/box_mesh.h"
#include "impact/fe/gmsh_mesh.h"
#include "impact/fe/hexahedron.h"
#include "impact/fe/locator.h"
#include "libdem/core/error.h"
#include "libdem/core/random.h"

namespace {

using fe::Vec3;
using testing::AllOf;
using testing::HasSubstr;

fe::BoxMeshOptions plain_box() {
  fe::BoxMeshOptions options;
  options.origin = Vec3(-1, 2, 0);
  options.size = Vec3(2, 1, 0.5);
  options.elements = {4, 2, 1};
  return options;
}

/// The message of the InputError that `act` throws; a failure if it throws none.
template <class Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const dem::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

/// A file in the test's scratch folder that vanishes with it.
struct ScratchFile {
  std::string path;
  ScratchFile(const std::string& name, const std::string& text) : path(testing::TempDir() + name) {
    std::ofstream(path) << text;
  }
  ~ScratchFile() { std::filesystem::remove(path); }
};

/// Two bricks of 1 x 1 x 1 in Gmsh's format 2.2, with the groups "solid" and "left".
std::string two_bricks(const std::string& first = "11 5 2 1 1 1 2 5 4 7 8 11 10") {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 2 \"left\"\n3 1 "
         "\"solid\"\n$EndPhysicalNames\n"
         "$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
         "7 0 0 1\n8 1 0 1\n9 2 0 1\n10 0 1 1\n11 1 1 1\n12 2 1 1\n$EndNodes\n$Elements\n3\n10 3 2 2 7 1 4 10 "
         "7\n" +
         first + "\n12 5 2 1 1 2 3 6 5 8 9 12 11\n$EndElements\n";
}

}  // namespace

TEST(BoxMesh, FillsTheBox) {
  const fe::Mesh mesh = fe::box_mesh(plain_box());
  EXPECT_EQ(mesh.elements.size(), 8u);
  EXPECT_EQ(mesh.nodes.size(), 5u * 3 * 2);
  EXPECT_NO_THROW(fe::check(mesh));
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) sum += fe::volume(mesh.corners(e));
  EXPECT_NEAR(sum, 1.0, 1e-14);
  EXPECT_NEAR(fe::shortest_edge(mesh), 0.5, 1e-15);
}

TEST(BoxMesh, SurroundsAZoneAndOverlapsItByLayers) {
  fe::BoxMeshOptions options;
  options.size = Vec3(10, 8, 4);
  options.elements = {10, 8, 4};
  options.zone = fe::DiscreteZone{Vec3(2, 2, 0), Vec3(8, 6, 4), 1};  // as thick as the slab
  const fe::Mesh mesh = fe::box_mesh(options);
  EXPECT_NO_THROW(fe::check(mesh));
  EXPECT_EQ(mesh.elements.size(), 10u * 8 * 4 - 4u * 2 * 4)
      << "the zone less one layer from each side, all its depth";
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Vec3 c = mesh.centre(e);
    EXPECT_FALSE(c.x() > 3 && c.x() < 7 && c.y() > 3 && c.y() < 5);
  }
}

TEST(BoxMesh, GrowsAwayFromTheZone) {
  fe::Grading grading;
  grading.zone_elements = 4;
  grading.growth = 1.5;
  grading.largest = 1.6;
  const std::vector<double> planes = fe::graded_planes(-7, 13, 2, 4, grading);
  EXPECT_EQ(planes.front(), -7);
  EXPECT_EQ(planes.back(), 13);
  EXPECT_THAT(planes, testing::IsSupersetOf({2.0, 2.5, 3.0, 3.5, 4.0}))
      << "the zone's faces and even steps between";
  const std::size_t first = std::find(planes.begin(), planes.end(), 2.0) - planes.begin();
  for (std::size_t k = first; k-- > 0;) {
    const double size = planes[k + 1] - planes[k], inner = planes[k + 2] - planes[k + 1];
    EXPECT_GE(size, inner * (1 - 1e-9));
    EXPECT_LE(size, std::min(1.5 * inner, 1.6) * (1 + 1e-9));
  }
  // 0.5 growing by half to 1.6: .75 + 1.125 + 1.6 + 1.6 + ... reach 9 with seven, six fall short.
  EXPECT_EQ(first, 7u);

  fe::BoxMeshOptions options;
  options.origin = Vec3(-7, 0, 0);
  options.size = Vec3(20, 1, 1);
  options.planes[0] = planes;
  options.elements = {static_cast<int>(planes.size()) - 1, 2, 2};
  options.zone = fe::DiscreteZone{Vec3(2, 0, 0), Vec3(4, 1, 1), 1};
  const fe::Mesh mesh = fe::box_mesh(options);
  EXPECT_NO_THROW(fe::check(mesh));
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) sum += fe::volume(mesh.corners(e));
  EXPECT_NEAR(sum, 19, 1e-12) << "all but what lies deeper in the zone than a layer of 0.5";
}

TEST(BoxMesh, AZoneAtTheFaceHasNothingBeyondIt) {
  fe::Grading grading;
  grading.zone_elements = 2;
  EXPECT_THAT(fe::graded_planes(0, 1, 0, 1, grading), testing::ElementsAre(0, 0.5, 1));
  EXPECT_THAT(fe::graded_planes(0, 1.1, 0, 1, grading), testing::ElementsAre(0, 0.5, 1, 1.1));
}

TEST(BoxMesh, RefusesAGradingThatCannotBe) {
  fe::Grading grading;
  EXPECT_THAT(refusal([&] { fe::graded_planes(0, 3, 1, 2, grading); }), HasSubstr("0 elements in the zone"));
  grading.zone_elements = 2;
  grading.growth = 0.9;
  EXPECT_THAT(refusal([&] { fe::graded_planes(0, 3, 1, 2, grading); }),
              HasSubstr("factor of 0.9; allowed: 1 to 3"));
  grading.growth = 1;
  grading.largest = 0.4;
  EXPECT_THAT(refusal([&] { fe::graded_planes(0, 3, 1, 2, grading); }),
              HasSubstr("not below those in the zone, 0.5 m"));
  grading.largest = 0;
  EXPECT_THAT(refusal([&] { fe::graded_planes(0, 1e5, 1, 2, grading); }),
              HasSubstr("more than 10000 elements"));
  fe::BoxMeshOptions options = plain_box();
  options.planes[1] = {2, 2.5, 2.9};
  EXPECT_THAT(refusal([&] { fe::box_mesh(options); }),
              HasSubstr("3 planes along y; 3 ascending ones are needed, from 2 to 3 m"));
}

TEST(BoxMesh, RefusesWhatCannotBeMeshed) {
  fe::BoxMeshOptions flat = plain_box();
  flat.size.z() = 0;
  EXPECT_THAT(refusal([&] { fe::box_mesh(flat); }), HasSubstr("size along z is 0 m"));
  fe::BoxMeshOptions none = plain_box();
  none.elements[1] = 0;
  EXPECT_THAT(refusal([&] { fe::box_mesh(none); }), HasSubstr("0 elements along y"));
  fe::BoxMeshOptions zone;
  zone.size = Vec3(10, 8, 4);
  zone.elements = {10, 8, 4};
  zone.zone = fe::DiscreteZone{Vec3(2.3, 2, 0), Vec3(8, 6, 4), 1};
  EXPECT_THAT(refusal([&] { fe::box_mesh(zone); }), AllOf(HasSubstr("x = 2.3 m"), HasSubstr("at 2 m")));
  zone.zone = fe::DiscreteZone{Vec3(2, 2, 0), Vec3(8, 6, 4), 2};
  EXPECT_THAT(refusal([&] { fe::box_mesh(zone); }), HasSubstr("2 overlap layers leave nothing"));
  zone.zone = fe::DiscreteZone{Vec3(2, 2, 0), Vec3(11, 6, 4), 1};
  EXPECT_THAT(refusal([&] { fe::box_mesh(zone); }), HasSubstr("must lie within the box"));
  zone.zone = fe::DiscreteZone{Vec3(0, 0, 0), Vec3(10, 8, 4), 1};
  EXPECT_THAT(refusal([&] { fe::box_mesh(zone); }), HasSubstr("fills the whole box"));
}

TEST(MeshCheck, NamesTheOffender) {
  fe::Mesh inverted = fe::box_mesh(plain_box());
  std::swap(inverted.elements[3][0], inverted.elements[3][1]);
  EXPECT_THAT(refusal([&] { fe::check(inverted); }), HasSubstr("structured mesh: element 3 is inverted"));

  fe::Mesh inside_out = fe::box_mesh(plain_box());
  for (std::size_t a = 0; a < 4; ++a) std::swap(inside_out.elements[5][a], inside_out.elements[5][a + 4]);
  EXPECT_THAT(refusal([&] { fe::check(inside_out); }), HasSubstr("element 5 is inverted"));

  fe::Mesh collapsed = fe::box_mesh(plain_box());
  collapsed.elements[2][1] = collapsed.elements[2][0];
  EXPECT_THAT(refusal([&] { fe::check(collapsed); }), HasSubstr("element 2 is degenerate"));

  fe::Mesh unused = fe::box_mesh(plain_box());
  unused.nodes.emplace_back(9, 9, 9);
  EXPECT_THAT(refusal([&] { fe::check(unused); }), HasSubstr("node 30 belongs to no element"));

  fe::Mesh stray = fe::box_mesh(plain_box());
  stray.elements[0][0] = 30;
  EXPECT_THAT(refusal([&] { fe::check(stray); }), HasSubstr("names node 30, of 30"));

  fe::Mesh twice = fe::box_mesh(plain_box());  // a gap: the last element gets a node of its own
  twice.nodes.push_back(twice.nodes[static_cast<std::size_t>(twice.elements[7][0])]);
  twice.elements[7][0] = 30;
  EXPECT_THAT(refusal([&] { fe::check(twice); }), AllOf(HasSubstr("lie at the same place"), HasSubstr("30")));

  fe::Mesh nan = fe::box_mesh(plain_box());
  nan.nodes[4].y() = std::nan("");
  EXPECT_THAT(refusal([&] { fe::check(nan); }), HasSubstr("node 4 has a coordinate that is no number"));

  fe::Mesh empty;
  empty.origin = "empty.msh";
  EXPECT_THAT(refusal([&] { fe::check(empty); }), HasSubstr("empty.msh: the mesh has no element"));
}

TEST(GmshMesh, ReadsHexahedraAndGroups) {
  const ScratchFile file("fe_two_bricks.msh", two_bricks());
  const fe::Mesh mesh = fe::read_gmsh(file.path, 0.001);
  ASSERT_EQ(mesh.elements.size(), 2u);
  EXPECT_EQ(mesh.nodes.size(), 12u);
  EXPECT_EQ(mesh.element_tags[0], 11u);
  EXPECT_NEAR(fe::volume(mesh.corners(0)), 1e-9, 1e-22);
  ASSERT_EQ(mesh.groups.count("left"), 1u);
  ASSERT_EQ(mesh.groups.at("left").size(), 4u);
  for (const std::int32_t node : mesh.groups.at("left"))
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(node)].x(), 0);
  EXPECT_EQ(mesh.groups.at("solid").size(), 12u);
  EXPECT_EQ(fe::read_gmsh(file.path).nodes[2], Vec3(2, 0, 0)) << "a second read starts afresh";
}

TEST(GmshMesh, RefusesWhatIsNoMeshOfBricks) {
  EXPECT_THAT(refusal([] { fe::read_gmsh("no/such.msh"); }), HasSubstr("no/such.msh: cannot be opened"));
  const ScratchFile script("fe_script.msh", "Point(1) = {0, 0, 0, 1};\n");
  EXPECT_THAT(refusal([&] { fe::read_gmsh(script.path); }), HasSubstr("it is no Gmsh mesh"));
  const ScratchFile broken("fe_broken.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0\n");
  EXPECT_THAT(refusal([&] { fe::read_gmsh(broken.path); }), HasSubstr("fe_broken.msh: "));
  const ScratchFile tetra("fe_tetra.msh", two_bricks("11 4 2 1 1 1 2 5 7"));
  EXPECT_THAT(refusal([&] { fe::read_gmsh(tetra.path); }),
              AllOf(HasSubstr("fe_tetra.msh: element 11 is a Tetrahedron"), HasSubstr("eight nodes")));
  const ScratchFile inverted("fe_inverted.msh", two_bricks("11 5 2 1 1 2 1 5 4 7 8 11 10"));
  EXPECT_THAT(refusal([&] { fe::read_gmsh(inverted.path); }), HasSubstr("element 11 is inverted"));
  const ScratchFile unused(
      "fe_unused.msh",  // format 4.1: one block of nodes, one of elements
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 9 1 77\n3 1 0 9\n"
      "1\n2\n3\n4\n5\n6\n7\n8\n77\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n5 5 5\n"
      "$EndNodes\n$Elements\n1 1 1 1\n3 1 5 1\n1 1 2 3 4 5 6 7 8\n$EndElements\n");
  EXPECT_THAT(refusal([&] { fe::read_gmsh(unused.path); }), HasSubstr("node 77 belongs to no element"));
  // Gmsh's library crashes on it; what it leaves is a line, as for any other file.
  const ScratchFile missing("fe_missing.msh", two_bricks("11 5 2 1 1 1 2 5 4 7 8 13 10"));
  EXPECT_THAT(refusal([&] { fe::read_gmsh(missing.path); }), HasSubstr("fe_missing.msh: Gmsh cannot read it"));
  const ScratchFile sound("fe_sound.msh", two_bricks());
  EXPECT_EQ(fe::read_gmsh(sound.path).elements.size(), 2U) << "and reads on";
  EXPECT_THAT(refusal([&] { fe::read_gmsh(sound.path, 0); }), HasSubstr("length unit is 0 m"));
}

TEST(Locator, FindsPointsInDistortedElementsTo1e12) {
  fe::BoxMeshOptions options;
  options.size = Vec3(1, 1, 1);
  options.elements = {5, 4, 3};
  fe::Mesh mesh = fe::box_mesh(options);
  dem::Random random(3);
  for (Vec3& node : mesh.nodes)
    for (int k = 0; k < 3; ++k)
      if (node[k] > 1e-9 && node[k] < 1 - 1e-9) node[k] += random.uniform(-0.05, 0.05);
  fe::check(mesh);
  const fe::Locator locator(mesh);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::size_t element = random.below(mesh.elements.size());
    const Vec3 local(random.uniform(-0.999, 0.999), random.uniform(-0.999, 0.999),
                     random.uniform(-0.999, 0.999));
    const Vec3 point = fe::position(mesh.corners(element), local);
    const auto found = locator.find(point);
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(found->element, static_cast<std::int32_t>(element));
    ASSERT_LT((found->local - local).cwiseAbs().maxCoeff(), 1e-12);
  }
  for (const Vec3& node : mesh.nodes)
    EXPECT_TRUE(locator.find(node).has_value()) << "corners belong to someone";
  EXPECT_FALSE(locator.find(Vec3(1.001, 0.5, 0.5)).has_value());
  EXPECT_FALSE(locator.find(Vec3(5, 5, 5)).has_value());
}

TEST(Locator, LeavesHolesEmpty) {
  fe::BoxMeshOptions options;
  options.size = Vec3(10, 8, 4);
  options.elements = {10, 8, 4};
  options.zone = fe::DiscreteZone{Vec3(2, 2, 0), Vec3(8, 6, 4), 1};
  const fe::Mesh mesh = fe::box_mesh(options);
  const fe::Locator locator(mesh);
  EXPECT_FALSE(locator.find(Vec3(5, 4, 2)).has_value());
  EXPECT_TRUE(locator.find(Vec3(2.5, 4, 2)).has_value());
}
