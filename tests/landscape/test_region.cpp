#include <gtest/gtest.h>

#include <cmath>

#include "landscape/shapes/region.h"

namespace ifov::landscape::test_region {
namespace {

Footprint square(double half_m) { return {{}, -half_m, half_m, -half_m, half_m}; }

/// Area of a mesh seen from above; faces that look down count negative.
double area_from_above(const geometry::TriangleMesh& mesh) {
  double area = 0.0;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[1]] - mesh.vertices_m[t[0]],
               b = mesh.vertices_m[t[2]] - mesh.vertices_m[t[0]];
    area += 0.5 * math::cross(a, b).z;
  }
  return area;
}

geometry::TriangleMesh paved(const Region& region, double cell_m = 30.0) {
  MeshBuilder mesh;
  region.pave(
      mesh, [](Vec2) { return 0.0; }, cell_m);
  return mesh.take();
}

TEST(Region, AreasAddUp) {
  const Region a = Region::rectangle(square(10.0)),
               b = Region::rectangle({{{5.0, 0.0}}, -10.0, 10.0, -3.0, 3.0});
  EXPECT_NEAR(a.area_m2(), 400.0, 1e-6);
  EXPECT_NEAR((a + b).area_m2(), 400.0 + 5.0 * 6.0, 1e-6);
  EXPECT_NEAR((a & b).area_m2(), 15.0 * 6.0, 1e-6);
  EXPECT_NEAR((a - b).area_m2(), 400.0 - 90.0, 1e-6);
  EXPECT_TRUE((b - a).contains({14.0, 0.0}));
  EXPECT_FALSE((b - a).contains({4.0, 0.0}));
}

TEST(Region, GrowingRoundsCorners) {
  const double r = 2.0;
  EXPECT_NEAR(Region::rectangle(square(10.0)).grown(r).area_m2(), 400.0 + 4.0 * 20.0 * r + M_PI * r * r,
              0.02);
  EXPECT_NEAR(Region::rectangle(square(10.0)).grown(-r).area_m2(), 16.0 * 16.0, 1e-6);
}

TEST(Region, PavesHolesWithoutLosingArea) {
  Region region = Region::rectangle(square(40.0));
  for (int k = 0; k < 5; ++k) region = region - Region::disc({-30.0 + 13.0 * k, 7.0 * k - 15.0}, 4.0);
  for (const double cell : {1000.0, 30.0, 7.0}) {
    const geometry::TriangleMesh mesh = paved(region, cell);
    EXPECT_NEAR(area_from_above(mesh), region.area_m2(), 0.05) << cell;
    for (const geometry::Triangle& t : mesh.triangles) {
      const Vec3 a = mesh.vertices_m[t[1]] - mesh.vertices_m[t[0]],
                 b = mesh.vertices_m[t[2]] - mesh.vertices_m[t[0]];
      EXPECT_GE(math::cross(a, b).z, -1e-6) << "a face looks down";
    }
  }
}

TEST(Region, SkirtsFaceOutwards) {
  MeshBuilder mesh;
  Region::rectangle(square(2.0))
      .skirt(
          mesh, [](Vec2) { return 1.0; }, 0.0);
  const geometry::TriangleMesh walls = mesh.take();
  ASSERT_EQ(walls.triangles.size(), 8u);
  for (const geometry::Triangle& t : walls.triangles) {
    const Point3 p = walls.vertices_m[t[0]], q = walls.vertices_m[t[1]], r = walls.vertices_m[t[2]];
    const Vec3 normal = math::cross(q - p, r - p);
    const Vec3 outward = (p - Point3{}) + (q - Point3{}) + (r - Point3{});
    EXPECT_GT(normal.x * outward.x + normal.y * outward.y, 0.0);
  }
}

}  // namespace
}  // namespace ifov::landscape::test_region
