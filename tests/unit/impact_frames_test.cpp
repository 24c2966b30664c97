// Pictures of an impact for ParaView, read back as HDF5.
#include "impact/frames.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"
#include "tests/unit/impact_scene.h"

using dem::Hdf5File;
using impact::Vec3;
using impact_test::rock_on_slab;
using testing::ElementsAre;

namespace {

namespace fs = std::filesystem;

/// Three elements in a row, two links, the second of them broken; element 2 has moved.
dem::Assembly row_of_three() {
  dem::MaterialCard card;
  const std::vector<Vec3> centres = {{0, 0, 0}, {0.02, 0, 0}, {0.04, 0, 0}};
  const std::vector<double> radii = {0.01, 0.01, 0.008};
  const std::vector<dem::LinkGeometry> pairs = {{0, 1, 0.02}, {1, 2, 0.02}};
  dem::Assembly assembly;
  assembly.particles = dem::Particles(centres, radii, 0.03);
  assembly.links = dem::make_links(pairs, radii);
  assembly.law = dem::make_link_law(card);
  assembly.links.max_strain[1] = 2 * assembly.law.breaking_strain();
  assembly.particles.kinematics[2].x = 0.05;
  assembly.particles.set_velocity(2, {3, 0, 0});
  return assembly;
}

class ImpactFrames : public impact_test::InFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path().filename().string());
    return found;
  }
  nlohmann::json json(const std::string& name) const {
    std::ifstream in(folder / name);
    return nlohmann::json::parse(in);
  }
};

/// By the divergence theorem.
double volume_of(const impact::Surface& surface) {
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& v = surface.vertices;
    volume += v[static_cast<std::size_t>(a)].dot(
                  v[static_cast<std::size_t>(b)].cross(v[static_cast<std::size_t>(c)])) /
              6;
  }
  return volume;
}

}  // namespace

TEST(ImpactorSurface, IsClosedAndLiesOnTheShape) {
  const double r = 0.1;
  const std::vector<impact::Shape> shapes = {
      impact::make_box({0.1, 0.2, 0.3}, "test"), impact::make_sphere(2 * r, "test"),
      impact::make_cylinder(2 * r, 0.5, impact::Nose::flat, "test"),
      impact::make_cylinder(2 * r, 0.5, impact::Nose::hemisphere, "test"),
      impact::make_cylinder(2 * r, r, impact::Nose::hemisphere, "test")};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const impact::Surface surface = impact::surface_of(shapes[k]);
    // Refuses what is open, wrongly oriented or degenerate.
    EXPECT_NO_THROW(impact::TriangleMesh(surface.vertices, surface.triangles, "surface")) << k;
    for (const Vec3& vertex : surface.vertices)
      EXPECT_NEAR(impact::nearest(shapes[k], vertex).distance, 0, 1e-12) << k;
    const double exact = impact::filled(shapes[k]).volume, volume = volume_of(surface);
    EXPECT_LE(volume, exact * (1 + 1e-12)) << k;
    EXPECT_GT(volume, exact * 0.98) << k;
  }
}

TEST_F(ImpactFrames, FramesShowElementsLinksAndImpactor) {
  const dem::Assembly assembly = row_of_three();
  impact::FrameWriter writer(rock_on_slab(), folder, false);
  impact::Frame frame;
  frame.assembly = &assembly;
  frame.number = 3;
  frame.time = 1e-3;
  frame.impactor.position = {0, 0, 2};
  writer.write(frame);
  const Hdf5File elements = Hdf5File::open(folder / "elements_0003.hdf");
  EXPECT_THAT(elements.read<double>("VTKHDF/Points", 3), ElementsAre(0, 0, 0, 0.02, 0, 0, 0.05, 0, 0));
  EXPECT_THAT(elements.read<double>("VTKHDF/PointData/radius"), ElementsAre(0.01, 0.01, 0.008));
  EXPECT_THAT(elements.read<double>("VTKHDF/PointData/damage"), ElementsAre(0, 0.5, 1));
  EXPECT_THAT(elements.read<std::int32_t>("VTKHDF/PointData/fragment"), ElementsAre(0, 0, 1));
  EXPECT_THAT(elements.read<double>("VTKHDF/PointData/velocity", 3), ElementsAre(0, 0, 0, 0, 0, 0, 3, 0, 0));
  EXPECT_NEAR(elements.read<double>("VTKHDF/PointData/displacement", 3)[6], 0.01, 1e-15);
  const Hdf5File links = Hdf5File::open(folder / "links_0003.hdf");
  EXPECT_THAT(links.read<std::uint8_t>("VTKHDF/CellData/state"), ElementsAre(0, 2));
  EXPECT_THAT(links.read<std::int64_t>("VTKHDF/Connectivity"), ElementsAre(0, 1, 1, 2));
  EXPECT_NEAR(links.read<double>("VTKHDF/CellData/strain")[1], 0.5, 1e-12);
  const Hdf5File impactor = Hdf5File::open(folder / "impactor_0003.hdf");
  EXPECT_THAT(impactor.read<std::uint8_t>("VTKHDF/Types"), testing::Each(5));
  EXPECT_NEAR(impactor.read<double>("VTKHDF/Points", 3)[2], 2 - 0.15, 1e-12);
  EXPECT_FALSE(fs::exists(folder / "finite_elements_0003.hdf"));
  EXPECT_FALSE(fs::exists(folder / "finite_elements.hdf.series"));
}

TEST_F(ImpactFrames, FramesShowFiniteElementsWhereTheyAre) {
  const dem::Assembly assembly = row_of_three();
  fe::BoxMeshOptions options;
  options.size = {1, 1, 1};
  options.elements = {1, 1, 1};
  const fe::Mesh mesh = fe::box_mesh(options);
  fe::State nodes(fe::Body(mesh, {30e9, 0.2, 2400}));
  nodes.displacement[7] = {0, 0, 0.5};
  nodes.velocity[7] = {1, 2, 3};
  impact::Scene scene = rock_on_slab();
  scene.impactor.reset();
  impact::FrameWriter writer(scene, folder, false);
  impact::Frame frame;
  frame.assembly = &assembly;
  frame.mesh = &mesh;
  frame.nodes = &nodes;
  writer.write(frame);
  const Hdf5File in = Hdf5File::open(folder / "finite_elements_0000.hdf");
  EXPECT_THAT(in.read<std::uint8_t>("VTKHDF/Types"), ElementsAre(12));
  const auto points = in.read<double>("VTKHDF/Points", 3);
  EXPECT_DOUBLE_EQ(points[23], mesh.nodes[7].z() + 0.5);
  EXPECT_DOUBLE_EQ(in.read<double>("VTKHDF/PointData/displacement", 3)[23], 0.5);
  EXPECT_DOUBLE_EQ(in.read<double>("VTKHDF/PointData/velocity", 3)[22], 2);
  EXPECT_EQ(json("finite_elements.hdf.series")["files"].size(), 1u);
  EXPECT_FALSE(fs::exists(folder / "impactor_0000.hdf"));
}

TEST_F(ImpactFrames, TheIndexKeepsFramesOverAResumeAndForgetsAFormerRun) {
  const dem::Assembly assembly = row_of_three();
  const auto write = [&](impact::FrameWriter& writer, int number, double time) {
    impact::Frame frame;
    frame.assembly = &assembly;
    frame.number = number;
    frame.time = time;
    writer.write(frame);
  };
  std::ofstream(folder / "elements_notes.hdf") << "the user's own";
  {
    impact::FrameWriter writer(rock_on_slab(), folder, false);
    for (int number = 0; number < 3; ++number) write(writer, number, 0.1 * number);
  }
  {
    impact::FrameWriter writer(rock_on_slab(), folder, true);
    write(writer, 2, 0.25);  // once more, after a stop
    write(writer, 3, 0.3);
    EXPECT_EQ(writer.count(), 4u);
  }
  const auto series = json("elements.hdf.series");
  EXPECT_EQ(series["file-series-version"], "1.0");
  ASSERT_EQ(series["files"].size(), 4u);
  EXPECT_EQ(series["files"][2]["name"], "elements_0002.hdf");
  EXPECT_EQ(series["files"][2]["time"], 0.25);
  EXPECT_EQ(series["files"][3]["name"], "elements_0003.hdf");
  EXPECT_EQ(json("links.hdf.series")["files"].size(), 4u);
  EXPECT_EQ(json("impactor.hdf.series")["files"].size(), 4u);

  std::ofstream(folder / "elements.hdf.series") << "{";
  EXPECT_THROW(impact::FrameWriter(rock_on_slab(), folder, true), dem::InputError);
  impact::FrameWriter anew(rock_on_slab(), folder, false);
  EXPECT_THAT(names(), ElementsAre("elements_notes.hdf"));
}
