#include <gtest/gtest.h>

#include <cmath>

#include "geometry/polygon_triangulation.h"
#include "math/transform.h"
#include "scene_maker.h"

namespace ifov::geometry::test_polygon_triangulation {
namespace {

using math::Point3;
using math::Vec3;

/// Areas of the triangles against the polygon's own; all must be wound as it is.
void expect_cut(const std::vector<Point3>& polygon) {
  const std::vector<Triangle> triangles = triangulate_polygon(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const Vec3 whole = polygon_area_vector(polygon);
  const double size = length(whole);
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const Vec3 a = cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]);
    EXPECT_GE(dot(a, whole) / size, -1e-9 * size);
    sum += length(a);
  }
  EXPECT_NEAR(sum, size, 1e-9 * size);  // without overlap: as much as the polygon, all of one sign
}

TEST(PolygonTriangulation, StarsOfManyShapes) {
  for (std::uint64_t key = 0; key < 300; ++key) {
    const auto n = static_cast<std::size_t>(3 + 40 * test::uniform(50, key));
    const math::Transform map =
        math::Transform::rotation(test::direction(51, key), 2.0) * math::Transform::translation({1, 2, 3});
    std::vector<Point3> polygon;
    for (std::size_t k = 0; k < n; ++k) {
      const double r = 0.05 + test::uniform(52 + key, k), a = 6.283185307179586 * double(k) / double(n);
      polygon.push_back(map(Point3{r * std::cos(a), r * std::sin(a), 0.0}));
    }
    expect_cut(polygon);
  }
}

TEST(PolygonTriangulation, CombsAndStraightCorners) {
  std::vector<Point3> comb;  // teeth upwards, with vertices in the middle of straight edges
  for (int k = 0; k < 10; ++k) {
    comb.push_back({2.0 * k, 1, 0});
    comb.push_back({2.0 * k, 5, 0});
    comb.push_back({2.0 * k + 0.5, 5, 0});
    comb.push_back({2.0 * k + 1, 5, 0});
    comb.push_back({2.0 * k + 1, 1, 0});
  }
  for (int k = 10; k >= 0; --k) comb.push_back({2.0 * k, 0, 0});
  expect_cut({comb.rbegin(), comb.rend()});
  expect_cut(comb);  // the other way round
}

TEST(PolygonTriangulation, SpiralsAreCut) {
  std::vector<Point3> spiral;
  for (int k = 0; k <= 60; ++k)
    spiral.push_back({(1 + 0.1 * k) * std::cos(0.3 * k), (1 + 0.1 * k) * std::sin(0.3 * k), 0});
  for (int k = 60; k >= 0; --k)
    spiral.push_back({(0.8 + 0.1 * k) * std::cos(0.3 * k), (0.8 + 0.1 * k) * std::sin(0.3 * k), 0});
  expect_cut(spiral);
}

TEST(PolygonTriangulation, HopelessInputEndsToo) {
  EXPECT_TRUE(triangulate_polygon({}).empty());
  const std::vector<Point3> crossing{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, point(7, Point3{1, 1, 1});
  EXPECT_EQ(triangulate_polygon(crossing).size(), 2u);
  EXPECT_EQ(triangulate_polygon(point).size(), 5u);
}

}  // namespace
}  // namespace ifov::geometry::test_polygon_triangulation
