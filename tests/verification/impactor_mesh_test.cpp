// Meshes against shapes that are known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "impact/impactors/mass_properties.h"
#include "impact/impactors/stl.h"
#include "tests/verification/impactor_scene.h"

using impact::Shape;
using impact::Vec3;
using impactor_scene::box_surface;
using impactor_scene::random_vector;
using impactor_scene::sphere_surface;

TEST(ImpactorMesh, StlCubeIsTheBox) {
  // 30 cm in whole millimetres, which single precision holds exactly.
  const Vec3 half(150, 200, 250);
  for (const std::string& bytes :
       {impactor_scene::binary_stl(box_surface(half)), impactor_scene::text_stl(box_surface(half))}) {
    const Shape mesh = impact::make_mesh(impact::parse_stl(bytes, "cube.stl", 0.001));
    const Shape box = impact::make_box({0.3, 0.4, 0.5}, "test");
    const impact::Filled a = impact::filled(mesh), b = impact::filled(box);
    EXPECT_NEAR(a.volume / b.volume, 1, 1e-12);
    EXPECT_LT(a.centre.norm(), 1e-12);
    EXPECT_LT((a.inertia - b.inertia).norm(), 1e-12 * b.inertia.norm());
    dem::Random random(3);
    for (int k = 0; k < 20000; ++k) {
      const Vec3 p = random_vector(random, 0.5);
      const impact::Nearest m = impact::nearest(mesh, p), e = impact::nearest(box, p);
      ASSERT_NEAR(m.distance, e.distance, 1e-12) << p.transpose();
      // Deep inside two faces may be equally near.
      if (e.distance > -0.1) {
        ASSERT_LT((m.point - e.point).norm(), 1e-12) << p.transpose();
        ASSERT_LT((m.normal - e.normal).norm(), 1e-9) << p.transpose();
      }
    }
    // Straight above faces, edges and corners, where features of the mesh meet.
    for (int k = 0; k < 27; ++k) {
      const int i = k % 3 - 1, j = k / 3 % 3 - 1, l = k / 9 - 1;
      const Vec3 p = Vec3(i, j, l).cwiseProduct(Vec3(0.17, 0.22, 0.27));
      const impact::Nearest m = impact::nearest(mesh, p), e = impact::nearest(box, p);
      EXPECT_NEAR(m.distance, e.distance, 1e-12) << p.transpose();
    }
  }
}

TEST(ImpactorMesh, PlaceAndTurnDoNotMatter) {
  impactor_scene::Surface s = box_surface({0.1, 0.2, 0.3});
  const impact::Filled plain = impact::filled(s.mesh());
  dem::Random random(5);
  const Eigen::Quaterniond turn = impactor_scene::random_turn(random);
  const Vec3 shift(100, -200, 300);
  for (Vec3& v : s.vertices) v = shift + turn * v;
  const impact::TriangleMesh moved = s.mesh();
  const impact::Filled far = impact::filled(moved);
  const dem::Mat3 r = turn.toRotationMatrix();
  EXPECT_LT((far.centre - shift).norm(), 1e-11);
  EXPECT_NEAR(far.volume / plain.volume, 1, 1e-11);
  EXPECT_LT((far.inertia - r * plain.inertia * r.transpose()).norm(), 1e-11 * plain.inertia.norm());
}

TEST(ImpactorMesh, SphereOfTrianglesConverges) {
  const impact::Filled exact = impact::filled(Shape(impact::make_sphere(0.6, "test")));
  const auto errors = [&](int levels) {
    const Shape mesh = impact::make_mesh(
        impact::parse_stl(impactor_scene::text_stl(sphere_surface(0.3, levels)), "ball.stl", 1));
    const impact::Filled found = impact::filled(mesh);
    double distance = 0;
    dem::Random random(11);
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p = random_vector(random, 0.6);
      distance = std::max(distance, std::abs(impact::nearest(mesh, p).distance - (p.norm() - 0.3)));
    }
    return std::array{std::abs(found.volume / exact.volume - 1),
                      (found.inertia - exact.inertia).norm() / exact.inertia.norm(), distance / 0.3};
  };
  const auto coarse = errors(3), fine = errors(4), finest = errors(5);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 2, 0.06) << k;
    EXPECT_NEAR(std::log2(fine[k] / finest[k]), 2, 0.02) << k;
    EXPECT_LT(finest[k], 4e-3) << k;
  }
  EXPECT_NEAR(std::log2(fine[2] / finest[2]), 2, 0.1);
}

TEST(ImpactorMesh, TreeFindsWhatLookingAtEveryTriangleFinds) {
  // A dented, lopsided ball; for the truth the distance to all triangles, each as a mesh's worth of segments,
  // would be the same code again: sample points of the surface bound the distance from above instead, and the
  // sign is the winding number's.
  impactor_scene::Surface s = sphere_surface(1, 4);
  for (Vec3& v : s.vertices) v *= 1 + 0.3 * std::sin(5 * v.x()) * std::cos(4 * v.y() + 1);
  const impact::TriangleMesh mesh = s.mesh();
  dem::Random random(17);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = random_vector(random, 1.6);
    double square = 1e300, angle = 0;
    for (const auto& t : mesh.triangles()) {
      const Vec3 a = mesh.vertices()[static_cast<std::size_t>(t[0])] - p,
                 b = mesh.vertices()[static_cast<std::size_t>(t[1])] - p,
                 c = mesh.vertices()[static_cast<std::size_t>(t[2])] - p;
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; i + j <= 8; ++j)
          square = std::min(square, ((i * a + j * b + (8 - i - j) * c) / 8).squaredNorm());
      // Solid angle of a triangle (van Oosterom and Strackee 1983).
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    const bool inside = angle > 2 * 3.14159265358979;
    const impact::Nearest found = mesh.nearest(p);
    EXPECT_EQ(found.distance < 0, inside) << p.transpose();
    EXPECT_LE(std::abs(found.distance), std::sqrt(square) * (1 + 1e-12));
    EXPECT_GE(std::abs(found.distance), std::sqrt(square) - 0.02);
    EXPECT_LT((found.point + found.distance * found.normal - p).norm(), 1e-12);
  }
}

TEST(ImpactorMesh, DistanceIsContinuousOverDents) {
  impactor_scene::Surface s = sphere_surface(1, 3);
  for (Vec3& v : s.vertices) v *= 1 + 0.3 * std::sin(5 * v.x());
  const impact::TriangleMesh mesh = s.mesh();
  // Along any line the distance changes by no more than the way gone.
  const Vec3 step(1e-4, 2e-4, -1e-4);
  Vec3 p(-1.3, -2.1, 1.2);
  double before = mesh.nearest(p).distance;
  for (int k = 0; k < 26000; ++k) {
    p += step;
    const double now = mesh.nearest(p).distance;
    ASSERT_LE(std::abs(now - before), step.norm() * (1 + 1e-9));
    before = now;
  }
}
