// Shapes, laws and states: bounds that are checked, measures, distances in places where the answer is plain.
#include "impact/impactors/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "impact/impactors/impactor.h"
#include "libdem/core/error.h"
#include "tests/message_of.h"
#include "tests/verification/impactor_scene.h"

using impact::Shape;
using impact::Vec3;
using test::message_of;
using testing::HasSubstr;

namespace {

void expect_nearest(const Shape& shape, const Vec3& point, double distance, const Vec3& normal) {
  const impact::Nearest found = impact::nearest(shape, point);
  EXPECT_NEAR(found.distance, distance, 1e-14) << point.transpose();
  EXPECT_LT((found.normal - normal.normalized()).norm(), 1e-14) << point.transpose() << ": " << found.normal;
  EXPECT_LT((found.point + found.distance * found.normal - point).norm(), 1e-14) << point.transpose();
}

dem::Particles elements(const std::vector<Vec3>& centres, double radius) {
  const std::vector<double> radii(centres.size(), radius);
  return {centres, radii, 1.0};
}

}  // namespace

TEST(ImpactorShape, DistancesOfABox) {
  const Shape box = impact::make_box({2, 4, 6}, "test");
  expect_nearest(box, {1.5, 0, 0}, 0.5, {1, 0, 0});
  expect_nearest(box, {4, 6, 0}, 5, {3, 4, 0});
  expect_nearest(box, {-2, -4, -5}, 3, {-1, -2, -2});
  expect_nearest(box, {0, 1.75, 0}, -0.25, {0, 1, 0});
  expect_nearest(box, {0, 0, -2.9}, -0.1, {0, 0, -1});
}

TEST(ImpactorShape, DistancesOfASphere) {
  const Shape sphere = impact::make_sphere(2, "test");
  expect_nearest(sphere, {3, 0, 4}, 4, {3, 0, 4});
  expect_nearest(sphere, {0, -0.5, 0}, -0.5, {0, -1, 0});
  expect_nearest(sphere, {0, 0, 0}, -1, {0, 0, 1});
}

TEST(ImpactorShape, DistancesOfCylinders) {
  const Shape flat = impact::make_cylinder(2, 6, impact::Nose::flat, "test");
  expect_nearest(flat, {0, 0, 4}, 1, {0, 0, 1});
  expect_nearest(flat, {3, 4, 0}, 4, {3, 4, 0});
  expect_nearest(flat, {0, 4, -7}, 5, {0, 3, -4});
  expect_nearest(flat, {0.9, 0, 0}, -0.1, {1, 0, 0});
  expect_nearest(flat, {0.5, 0, 2.75}, -0.25, {0, 0, 1});

  // Centre of mass from the back: (5 pi * 2.5 + 2/3 pi * (5 + 3/8)) / (5 2/3 pi).
  const impact::Cylinder round = impact::make_cylinder(2, 6, impact::Nose::hemisphere, "test");
  EXPECT_NEAR(-round.back, (12.5 + 2.0 / 3 * 5.375) / (5 + 2.0 / 3), 1e-14);
  const double shoulder = round.front - 1;
  expect_nearest(round, {3, 0, shoulder + 4}, 4, {3, 0, 4});
  expect_nearest(round, {0, 0, round.front + 0.5}, 0.5, {0, 0, 1});
  expect_nearest(round, {0, 0.75, shoulder - 1}, -0.25, {0, 1, 0});
  expect_nearest(round, {0.3, 0, shoulder + 0.4}, -0.5, {3, 0, 4});
  expect_nearest(round, {0, 2, round.back - 1}, std::sqrt(2), {0, 1, -1});
  // A mere hemisphere: inside near its flat face that face is nearest, not the nose.
  const impact::Cylinder cap = impact::make_cylinder(2, 1, impact::Nose::hemisphere, "test");
  expect_nearest(cap, {0, 0, cap.back + 0.1}, -0.1, {0, 0, -1});
}

TEST(ImpactorShape, BoundingBoxesHoldTheShape) {
  dem::Random random(7);
  const std::vector<Shape> shapes = {impact::make_box({1, 2, 3}, "test"), impact::make_sphere(1, "test"),
                                     impact::make_cylinder(1, 2, impact::Nose::flat, "test"),
                                     impact::make_cylinder(1, 2, impact::Nose::hemisphere, "test"),
                                     impact::make_mesh(impactor_scene::sphere_surface(1, 2).mesh())};
  for (const Shape& shape : shapes) {
    const Eigen::AlignedBox3d box = impact::bounding_box(shape);
    Eigen::AlignedBox3d touched;
    for (int k = 0; k < 20000; ++k) {
      const Vec3 on = impact::nearest(shape, impactor_scene::random_vector(random, 10)).point;
      touched.extend(on);
      EXPECT_LT(box.exteriorDistance(on), 1e-12);
    }
    for (int k = 0; k < 100; ++k) {
      // A plane that far away touches the shape: the point nearest to one far out on its normal lies in it.
      const Vec3 n = impactor_scene::random_vector(random, 1).normalized();
      EXPECT_NEAR(impact::nearest(shape, 1e4 * n).point.dot(n), impact::reach_along(shape, n), 1e-3);
      EXPECT_LE(impact::nearest(shape, 10 * n).point.dot(n), impact::reach_along(shape, n) + 1e-12);
    }
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(impact::reach_along(shape, -Vec3::Unit(axis)), -box.min()[axis], 1e-12);
    EXPECT_LT((touched.sizes() - box.sizes()).norm(), 0.02) << shape.index();
  }
}

TEST(ImpactorShape, LeadsWithFaceEdgeAndCorner) {
  const Vec3 half(0.15, 0.2, 0.25), down(0, 0, -1);
  const auto turned = [&](impact::Lead lead, const Vec3& local) -> Vec3 {
    return impact::leading(lead, half, down) * local;
  };
  EXPECT_LT((turned(impact::Lead::face, {0, 0, 0.25}) - Vec3(0, 0, -0.25)).norm(), 1e-15);
  EXPECT_NEAR(turned(impact::Lead::edge, {0, 0.2, 0.25}).z(), -std::hypot(0.2, 0.25), 1e-15);
  EXPECT_NEAR(turned(impact::Lead::edge, {0.15, 0.2, 0.25}).z(), -std::hypot(0.2, 0.25), 1e-15);
  EXPECT_NEAR(turned(impact::Lead::corner, half).z(), -half.norm(), 1e-15);
}

TEST(ImpactorShape, RefusesMeasuresThatCannotBe) {
  EXPECT_THAT(
      message_of([] {
        impact::make_box({1, 0, 1}, "case.toml: impactor.size");
      }),
      HasSubstr("case.toml: impactor.size: the impactor's size is 0 m; it must be positive and finite"));
  EXPECT_THAT(message_of([] { impact::make_sphere(-1, "x"); }), HasSubstr("diameter is -1 m"));
  EXPECT_THAT(message_of([] {
                impact::make_cylinder(std::numeric_limits<double>::infinity(), 1, impact::Nose::flat, "x");
              }),
              HasSubstr("diameter is inf m"));
  EXPECT_THAT(message_of([] { impact::make_cylinder(2, 0.5, impact::Nose::hemisphere, "x"); }),
              HasSubstr("a length of 0.5 m is less than the nose's radius of 1 m"));
  const Shape ball = impact::make_sphere(1, "x");
  EXPECT_THAT(message_of([&] { impact::from_density(ball, 0, "x"); }), HasSubstr("density is 0 kg/m3"));
  EXPECT_THAT(message_of([&] { impact::from_mass(ball, std::nan(""), "x"); }), HasSubstr("mass is nan kg"));
  EXPECT_THAT(message_of([] {
                impact::RigidBody({1, impact::Mat3::Zero()}, {}, "x");
              }),
              HasSubstr("smallest moment of inertia is 0 kg m2"));
}

TEST(ImpactorShape, RefusesLawsThatCannotBe) {
  impact::ContactLaw law;
  const auto refusal = [&] { return message_of([&] { law.validate("case.toml: impactor.contact"); }); };
  EXPECT_THAT(refusal(),
              HasSubstr("case.toml: impactor.contact: the contact's modulus is 0; it must be positive"));
  law.stiffness = -1;
  EXPECT_THAT(refusal(), HasSubstr("stiffness is -1"));
  law.stiffness = 1e9;
  EXPECT_EQ(refusal(), "no error");
  law.friction = -0.1;
  EXPECT_THAT(refusal(), HasSubstr("friction is -0.1"));
  law.friction = 0.1, law.damping_ratio = 1.5;
  EXPECT_THAT(refusal(), HasSubstr("damping ratio is 1.5; it must be from 0 to 1"));
  law.damping_ratio = 0, law.shear_ratio = std::nan("");
  EXPECT_THAT(refusal(), HasSubstr("shear ratio is nan"));
  law.shear_ratio = 1, law.spring = impact::NormalSpring::hertz;
  EXPECT_THAT(refusal(), HasSubstr("a stiffness and a Hertzian spring"));
}

TEST(Impactor, FindsTheDeepestOverlap) {
  const Shape box = impact::make_box({1, 1, 1}, "test");
  const dem::Particles some = elements({{0, 0, 0.65}, {0.8, 0, 0}, {0, 0, 0.575}, {0, 5, 0}}, 0.1);
  const impact::Gap inside = impact::nearest_gap(box, {}, some);
  EXPECT_EQ(inside.element, 2);
  EXPECT_NEAR(inside.gap, -0.025, 1e-15);
  const impact::Gap apart = impact::nearest_gap(box, {{0, 0, -1}, Eigen::Quaterniond::Identity()}, some);
  EXPECT_EQ(apart.element, 1);
  EXPECT_NEAR(apart.gap, std::hypot(0.3, 0.5) - 0.1, 1e-15);
  EXPECT_EQ(impact::nearest_gap(box, {}, elements({}, 0.1)).element, -1);
}

TEST(Impactor, FindsHowFarItIsToTheElements) {
  const Shape ball = impact::make_sphere(1, "test");
  const dem::Particles one = elements({{3, 0.3, 0}}, 0.1);
  // Centres 0.6 apart when they touch.
  const auto there = impact::distance_to_contact(ball, {}, Vec3::UnitX(), one);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(*there, 3 - std::sqrt(0.36 - 0.09), 1e-8);
  EXPECT_FALSE(impact::distance_to_contact(ball, {}, -Vec3::UnitX(), one).has_value());
  EXPECT_FALSE(impact::distance_to_contact(ball, {}, Vec3::UnitZ(), one).has_value());
  EXPECT_EQ(impact::distance_to_contact(ball, {{3, 0, 0}, Eigen::Quaterniond::Identity()}, Vec3::UnitX(), one),
            0);
}

TEST(Impactor, RefusesNumbersThatAreNoState) {
  auto numbers = impact::to_numbers({});
  EXPECT_TRUE(impact::from_numbers(numbers, "checkpoint.h5").contacts.empty());
  numbers["impactor_contacts"] = {1, 2, 3};
  EXPECT_THAT(message_of([&] { impact::from_numbers(numbers, "checkpoint.h5"); }),
              HasSubstr("checkpoint.h5: the impactor's state has 23 and 3 numbers"));
  numbers.erase("impactor_contacts");
  EXPECT_THAT(message_of([&] { impact::from_numbers(numbers, "checkpoint.h5"); }),
              HasSubstr("'impactor_contacts' is missing"));
}
