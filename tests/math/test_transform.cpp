#include <gtest/gtest.h>

#include <numbers>

#include "math/transform.h"

namespace ifov::math::test_transform {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Transform, RotationIsRightHanded) {
  expect_near(Transform::rotation({0, 0, 2}, kQuarterTurn)(Vec3{1, 0, 0}), {0, 1, 0}, 1e-15);
  expect_near(Transform::rotation({1, 0, 0}, kQuarterTurn)(Vec3{0, 1, 0}), {0, 0, 1}, 1e-15);
  expect_near(Transform::rotation({0, 5, 0}, kQuarterTurn)(Vec3{0, 0, 1}), {1, 0, 0}, 1e-15);
  // A third of a turn about the diagonal permutes the axes.
  expect_near(Transform::rotation({1, 1, 1}, 2.0 * std::numbers::pi / 3.0)(Vec3{1, 0, 0}), {0, 1, 0}, 1e-15);
}

TEST(Transform, PointsMoveVectorsDoNot) {
  const Transform t = Transform::translation({1, 2, 3});
  EXPECT_EQ(t(Point3{10, 20, 30}), (Point3{11, 22, 33}));
  EXPECT_EQ(t(Vec3{10, 20, 30}), (Vec3{10, 20, 30}));
}

TEST(Transform, ProductAppliesTheRightFactorFirst) {
  const Transform turn = Transform::rotation({0, 0, 1}, kQuarterTurn),
                  shift = Transform::translation({1, 0, 0});
  expect_near((turn * shift)(Point3{}) - Point3{}, {0, 1, 0}, 1e-15);
  expect_near((shift * turn)(Point3{}) - Point3{}, {1, 0, 0}, 1e-15);
}

TEST(Transform, InverseUndoes) {
  const Transform t = Transform::translation({4e5, -5e6, 30}) * Transform::rotation({1, 2, 3}, 0.7) *
                      Transform::scaling({2, -3, 0.5});
  const Point3 p{1.5, -2.5, 3.5};
  expect_near(t.inverse()(t(p)) - p, {}, 1e-8);
  EXPECT_NEAR(t.determinant(), -3.0, 1e-12);
  EXPECT_NEAR(t.inverse().determinant(), -1.0 / 3.0, 1e-12);
}

TEST(Transform, NormalsStayPerpendicular) {
  const Transform squeeze = Transform::rotation({0, 1, 0}, 0.3) * Transform::scaling({1, 2, 5});
  const Vec3 a{1, 0, -1}, b{0, 1, 0.25};
  const Normal3 n = squeeze(as_normal(cross(a, b)));
  EXPECT_NEAR(dot(n, squeeze(a)), 0.0, 1e-15);
  EXPECT_NEAR(dot(n, squeeze(b)), 0.0, 1e-15);
  EXPECT_NEAR(length(n.as_vector()), 1.0, 1e-15);
}

TEST(Transform, MirroringKeepsOutsideOutside) {
  const Transform mirror = Transform::scaling({1, 1, -1});
  expect_near(mirror(Normal3{0, 0, 1}).as_vector(), {0, 0, -1}, 0.0);
  expect_near(mirror(Normal3{1, 0, 0}).as_vector(), {1, 0, 0}, 0.0);
}

}  // namespace
}  // namespace ifov::math::test_transform
