// STL in, and what is refused.
#include "impact/impactors/stl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>

#include "impact/impactors/shape.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "tests/message_of.h"
#include "tests/verification/impactor_scene.h"

using impactor_scene::binary_stl;
using impactor_scene::box_surface;
using impactor_scene::Surface;
using impactor_scene::text_stl;
using test::message_of;
using testing::HasSubstr;
using Vec3 = dem::Vec3;

namespace {

std::string refusal(const std::string& bytes, double unit = 1) {
  return message_of([&] { impact::parse_stl(bytes, "rock.stl", unit); });
}

std::string refusal(const Surface& surface) { return refusal(binary_stl(surface)); }

Surface cube() { return box_surface({1, 1, 1}); }

}  // namespace

TEST(ImpactorStl, ReadsBothForms) {
  for (const std::string& bytes : {binary_stl(cube()), text_stl(cube())}) {
    const impact::TriangleMesh mesh = impact::parse_stl(bytes, "rock.stl", 0.001);
    EXPECT_EQ(mesh.triangles().size(), 12u);
    EXPECT_EQ(mesh.vertices().size(), 8u);
    EXPECT_NEAR(mesh.bounding_box().max().x(), 0.001, 1e-15);
  }
}

TEST(ImpactorStl, ReadsSeveralSolidsAndOddNormals) {
  std::string text = text_stl(cube());
  text.replace(text.find("0 0 0"), 5, "nan nan nan");
  Surface other = cube();
  for (Vec3& v : other.vertices) v.x() += 5;
  const impact::TriangleMesh mesh = impact::parse_stl(text + text_stl(other), "rock.stl", 1);
  EXPECT_EQ(mesh.triangles().size(), 24u);
}

TEST(ImpactorStl, ReadsAFile) {
  const auto file = std::filesystem::temp_directory_path() / "spall_impactor_stl_test.stl";
  dem::write_file_atomically(file, binary_stl(cube()));
  EXPECT_EQ(impact::read_stl(file, 1).triangles().size(), 12u);
  std::filesystem::remove(file);
  EXPECT_THAT(message_of([&] { impact::read_stl(file, 1); }),
              HasSubstr("spall_impactor_stl_test.stl: there is no such file"));
  EXPECT_THAT(message_of([&] { impact::read_stl(file.parent_path(), 1); }), HasSubstr("folder"));
}

TEST(ImpactorStl, RefusesFilesThatAreNone) {
  EXPECT_THAT(refusal(""), HasSubstr("rock.stl: the file is empty"));
  EXPECT_THAT(refusal("what is this"), HasSubstr("rock.stl: 12 bytes are no STL file"));
  std::string cut = binary_stl(cube());
  cut[0] = 'b';
  cut.resize(cut.size() - 7);
  EXPECT_THAT(refusal(cut), HasSubstr("677 bytes do not fit the 12 triangles that it announces (684 bytes)"));
  EXPECT_THAT(refusal(text_stl(cube()).substr(0, 200)), HasSubstr("rock.stl:"));
  std::string broken = text_stl(cube());
  broken.replace(broken.find("vertex"), 6, "vertes");
  EXPECT_THAT(refusal(broken), HasSubstr("rock.stl:4: 'vertes' stands where 'vertex' should be"));
  broken = text_stl(cube());
  broken.replace(broken.find("vertex -1"), 9, "vertex 1x");
  EXPECT_THAT(refusal(broken), HasSubstr("'1x' stands where a number should be"));
  EXPECT_THAT(refusal("solid\nendsolid\n"), HasSubstr("the mesh has no triangle"));
  EXPECT_THAT(refusal(binary_stl(cube()), 0), HasSubstr("a unit of 0 m"));
}

TEST(ImpactorStl, RefusesSurfacesThatEncloseNothing) {
  Surface open = cube();
  open.triangles.pop_back();
  EXPECT_THAT(refusal(open), HasSubstr("the surface is open there"));
  EXPECT_THAT(refusal(open), HasSubstr("rock.stl: triangle "));

  Surface turned = cube();
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_THAT(refusal(turned), HasSubstr("in the same sense as triangle"));

  Surface inward = cube();
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(refusal(inward), HasSubstr("rock.stl: the mesh encloses a volume of -8 m3"));

  Surface thin = cube();
  thin.vertices[3] = 0.5 * (thin.vertices[1] + thin.vertices[2]);
  EXPECT_THAT(refusal(thin), HasSubstr("rock.stl: triangle 2: it has no area"));

  Surface doubled = cube();
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_THAT(refusal(doubled), HasSubstr("rock.stl: triangle 13"));

  Surface lost = cube();
  lost.vertices[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(lost), HasSubstr("triangle 4: a coordinate is not a finite number"));

  EXPECT_THAT(message_of([] {
                impact::TriangleMesh({Vec3::Zero()}, {{0, 1, 2}}, "rock");
              }),
              HasSubstr("rock: triangle 1: its corner 1 is none of the 1 vertices"));
}
