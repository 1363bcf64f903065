// Every shape against its closed form, through the whole path: builder, Embree, double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_world {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

const std::array<std::uint32_t, 1> kOne{7};

std::unique_ptr<World> world_of(Shape shape, const Transform& map = {}) {
  WorldBuilder builder;
  const ShapeId id = builder.add_shape(std::move(shape));
  std::vector<std::uint32_t> materials(builder.slot_count(id), 7);
  builder.place(id, map, materials);
  return builder.build(1);
}

SurfacePoint hit_of(const World& world, Point3 from, Vec3 along) {
  const Ray ray{from, normalized(along)};
  SurfacePoint hit;
  world.intersect({&ray, 1}, {&hit, 1});
  return hit;
}

bool blocked(const World& world, const Ray& ray) {
  std::uint8_t answer = 2;
  world.occluded({&ray, 1}, {&answer, 1});
  EXPECT_LE(answer, 1);
  return answer != 0;
}

TEST(World, NothingIsMetInAnEmptyWorld) {
  WorldBuilder builder;
  const auto world = builder.build(1);
  EXPECT_FALSE(hit_of(*world, {0, 0, 10}, {0, 0, -1}).hit());
  EXPECT_FALSE(blocked(*world, {{0, 0, 10}, {0, 0, -1}}));
  EXPECT_EQ(world->object_count(), 0u);
}

TEST(World, PlaneIsExactFromOrbit) {
  const auto world = world_of(Plane{12.0});
  for (std::uint64_t i = 0; i < 200; ++i) {
    Vec3 d = test::direction(3, i);
    d.z = -0.05 - std::abs(d.z);
    const Point3 from{4e5 * test::uniform(4, i), -3e5, 700e3};
    const SurfacePoint hit = hit_of(*world, from, d);
    ASSERT_TRUE(hit.hit());
    const double t = (12.0 - from.z) / normalized(d).z;
    EXPECT_NEAR(hit.distance_m, t, 1e-9 * t);
    EXPECT_NEAR(hit.position_m.z, 12.0, 1e-7);
    EXPECT_TRUE(hit.front);
    EXPECT_EQ(hit.material, 7u);
    EXPECT_EQ(hit.geometric_normal, (math::Normal3{0, 0, 1}));
  }
  EXPECT_FALSE(hit_of(*world, {0, 0, 20}, {1, 0, 0}).hit());
  EXPECT_FALSE(hit_of(*world, {0, 0, 11}, {0, 0, -1}).hit());
  EXPECT_FALSE(hit_of(*world, {0, 0, 11}, {0, 0, 1}).front);
  EXPECT_TRUE(std::isinf(world->object(0).radius_m));
  EXPECT_FALSE(world->object(0).compact);
}

TEST(World, SphereIsExact) {
  const Point3 centre{100.0, -40.0, 30.0};
  const auto world = world_of(Sphere{centre, 2.5});
  int met = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vec3 d = test::direction(5, i);
    const Point3 from = centre - d * (i % 2 ? 50.0 : 700e3) + test::direction(6, i) * 3.0;
    const Vec3 to_centre = centre - from;
    const double closest = dot(to_centre, d), miss2 = dot(to_centre - d * closest, to_centre - d * closest);
    const SurfacePoint hit = hit_of(*world, from, d);
    ASSERT_EQ(hit.hit(), miss2 < 2.5 * 2.5) << i;
    if (!hit.hit()) continue;
    ++met;
    const double t = closest - std::sqrt(2.5 * 2.5 - miss2);
    EXPECT_NEAR(hit.distance_m, t, 1e-6);
    EXPECT_NEAR(length(hit.position_m - centre), 2.5, 1e-8);
    EXPECT_NEAR(dot(hit.geometric_normal, (hit.position_m - centre) / 2.5), 1.0, 1e-10);
    EXPECT_TRUE(hit.front);
  }
  EXPECT_GT(met, 500);
  const SurfacePoint inside = hit_of(*world, centre, {0, 0, 1});
  EXPECT_NEAR(inside.distance_m, 2.5, 1e-12);
  EXPECT_FALSE(inside.front);
  EXPECT_GT(inside.geometric_normal.z, 0.999);
}

TEST(World, UnequalScaleMakesAnEllipsoid) {
  const Transform map = Transform::translation({10, 20, 30}) *
                        Transform::rotation({0, 0, 1}, std::numbers::pi / 2) * Transform::scaling({1, 2, 3});
  const auto world = world_of(Sphere{{}, 1.0}, map);
  const SurfacePoint side = hit_of(*world, {0, 20, 30}, {1, 0, 0});  // the axis of length 2, turned onto -x
  EXPECT_NEAR(side.position_m.x, 8.0, 1e-12);
  EXPECT_NEAR(side.geometric_normal.x, -1.0, 1e-12);
  EXPECT_NEAR(hit_of(*world, {10, 20, 100}, {0, 0, -1}).position_m.z, 33.0, 1e-12);
  const SurfacePoint oblique = hit_of(*world, {10.3, 20.2, 100}, {0, 0, -1});
  // Normal of x^2/4 + y^2 + z^2/9 = 1.
  const Vec3 p = oblique.position_m - Point3{10, 20, 30}, n = math::normalized({p.x / 4, p.y, p.z / 9});
  EXPECT_NEAR(dot(oblique.geometric_normal, n), 1.0, 1e-12);
}

TEST(World, BoxHasSixPatches) {
  const auto world = world_of(Box{{-1, -2, 0}, {1, 2, 3}});
  const std::array<Vec3, 6> outward{Vec3{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  const Point3 middle{0, 0, 1.5};
  for (std::uint32_t face = 0; face < 6; ++face) {
    const SurfacePoint hit =
        hit_of(*world, middle + outward[face] * 50.0 + Vec3{0.1, 0.1, 0.1}, -outward[face]);
    ASSERT_TRUE(hit.hit());
    EXPECT_EQ(hit.patch, face);
    EXPECT_NEAR(dot(hit.geometric_normal, outward[face]), 1.0, 1e-15);
    EXPECT_TRUE(hit.front);
    const SurfacePoint from_inside = hit_of(*world, middle, outward[face]);
    EXPECT_EQ(from_inside.patch, face);
    EXPECT_FALSE(from_inside.front);
  }
  const SurfacePoint top = hit_of(*world, {0.5, 1.0, 9}, {0, 0, -1});
  EXPECT_NEAR(top.u, 0.75, 1e-14);
  EXPECT_NEAR(top.v, 0.75, 1e-14);
}

TEST(World, HemisphereHasNoFloor) {
  const auto world = world_of(Hemisphere{{0, 0, 5}, 2.0});
  EXPECT_NEAR(hit_of(*world, {0, 0, 100}, {0, 0, -1}).position_m.z, 7.0, 1e-12);
  const SurfacePoint from_below = hit_of(*world, {0.5, 0, -100}, {0, 0, 1});
  EXPECT_FALSE(from_below.front);
  EXPECT_NEAR(from_below.position_m.z, 5.0 + std::sqrt(4.0 - 0.25), 1e-12);
  EXPECT_FALSE(hit_of(*world, {-10, 0, 4.9}, {1, 0, 0}).hit());
}

TEST(World, CylinderCappedAndNot) {
  const auto capped = world_of(Cylinder{{1, 1, 0}, 0.5, 4.0, true}),
             open = world_of(Cylinder{{1, 1, 0}, 0.5, 4.0, false});
  const SurfacePoint top = hit_of(*capped, {1.1, 1.0, 50}, {0, 0, -1});
  EXPECT_EQ(top.patch, 2u);
  EXPECT_NEAR(top.position_m.z, 4.0, 1e-12);
  EXPECT_EQ(hit_of(*capped, {1.1, 1.0, -50}, {0, 0, 1}).patch, 1u);
  EXPECT_NEAR(hit_of(*capped, {1.1, 1.0, -50}, {0, 0, 1}).geometric_normal.z, -1.0, 1e-15);
  EXPECT_FALSE(hit_of(*open, {1.1, 1.0, 50}, {0, 0, -1}).hit());
  const SurfacePoint side = hit_of(*open, {-9, 1.0, 2}, {1, 0, 0});
  EXPECT_EQ(side.patch, 0u);
  EXPECT_NEAR(side.position_m.x, 0.5, 1e-12);
  EXPECT_NEAR(side.v, 0.5, 1e-12);
  EXPECT_NEAR(side.u, 0.5, 1e-12);
}

TEST(World, DiskIsRound) {
  const auto world = world_of(Disk{{3, 4, 1}, 2.0}, Transform::translation({0, 0, 1}));
  int met = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double x = 1.0 + 4.0 * test::uniform(8, 2 * i), y = 2.0 + 4.0 * test::uniform(8, 2 * i + 1);
    const SurfacePoint hit = hit_of(*world, {x, y, 10}, {0, 0, -1});
    ASSERT_EQ(hit.hit(), std::hypot(x - 3, y - 4) < 2.0);
    met += hit.hit();
  }
  EXPECT_NEAR(met / 4000.0, std::numbers::pi / 4, 0.02);
}

TEST(World, ConcavePolygonIsOnePatch) {
  // An L: the unit square's upper right quarter is missing.
  const auto world = world_of(Polygon{{{0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {1, 1, 2}, {1, 2, 2}, {0, 2, 2}}});
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double x = 3 * test::uniform(9, 2 * i) - 0.5, y = 3 * test::uniform(9, 2 * i + 1) - 0.5;
    const bool within = x > 0 && y > 0 && x < 2 && y < 2 && !(x > 1 && y > 1);
    const SurfacePoint hit = hit_of(*world, {x, y, 10}, {0, 0, -1});
    ASSERT_EQ(hit.hit(), within) << x << " " << y;
    if (!within) continue;
    EXPECT_EQ(hit.patch, 0u);
    EXPECT_TRUE(hit.front);
    EXPECT_NEAR(hit.u, x / 2, 1e-12);
    EXPECT_NEAR(hit.v, y / 2, 1e-12);
  }
}

TEST(World, MeshEqualsBruteForce) {
  const TriangleMesh mesh = test::height_field(20, {});
  const auto world = world_of(mesh);
  EXPECT_EQ(world->triangle_count(), 800u);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Ray ray{{24 * test::uniform(10, 2 * i) - 12, 24 * test::uniform(10, 2 * i + 1) - 12, 30},
                  normalized(test::direction(11, i) * 0.3 + Vec3{0, 0, -1})};
    SurfacePoint hit;
    world->intersect({&ray, 1}, {&hit, 1});
    const test::BruteHit truth = test::brute_force(mesh.vertices_m, mesh.triangles, ray);
    if (std::isfinite(truth.t) && truth.margin > 1e-5) {
      ASSERT_TRUE(hit.hit());
      EXPECT_EQ(hit.primitive, truth.triangle);
      EXPECT_NEAR(hit.distance_m, truth.t, 1e-10);
    } else if (!std::isfinite(truth.t) && hit.hit()) {
      ADD_FAILURE() << "a hit where there is nothing";
    }
  }
}

TEST(World, LimitsOfTheRayAreStrict) {
  const auto world = world_of(Box{{0, 0, 0}, {1, 1, 1}});
  const Point3 above{0.5, 0.5, 3};
  EXPECT_TRUE(blocked(*world, {above, {0, 0, -1}}));
  EXPECT_FALSE(blocked(*world, {above, {0, 0, -1}, 0.0, 2.0}));
  EXPECT_TRUE(blocked(*world, {above, {0, 0, -1}, 0.0, 2.0 + 1e-9}));
  EXPECT_FALSE(blocked(*world, {above, {0, 0, -1}, 3.0, 10.0}));
  EXPECT_TRUE(blocked(*world, {above, {0, 0, -1}, 3.0 - 1e-9, 10.0}));
  EXPECT_FALSE(blocked(*world, {above, {0, 0, 1}}));

  const auto mesh = world_of(test::height_field(8, {}));
  const Ray down{{0.3, 0.4, 20}, {0, 0, -1}};
  SurfacePoint hit;
  mesh->intersect({&down, 1}, {&hit, 1});
  ASSERT_TRUE(hit.hit());
  EXPECT_TRUE(blocked(*mesh, down));
  EXPECT_FALSE(blocked(*mesh, {down.origin_m, down.direction, 0.0, hit.distance_m - 1e-9}));
  EXPECT_TRUE(blocked(*mesh, {down.origin_m, down.direction, 0.0, hit.distance_m + 1e-9}));
  EXPECT_FALSE(blocked(*mesh, {down.origin_m, down.direction, hit.distance_m + 1e-9}));
  EXPECT_TRUE(blocked(*mesh, {down.origin_m, down.direction, hit.distance_m - 1e-9}));
}

TEST(World, ShapesStandOnAPlane) {
  WorldBuilder builder;
  const ShapeId plane = builder.add_shape(Plane{}), box = builder.add_shape(Box{{0, 0, 0}, {1, 1, 1}});
  builder.place(plane, {}, std::array<std::uint32_t, 1>{1});
  for (int i = 0; i < 50; ++i)
    builder.place(box, Transform::translation({3.0 * i, 0, 0}),
                  std::array<std::uint32_t, 1>{std::uint32_t(2 + i)});
  const auto world = builder.build(1);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(hit_of(*world, {3.0 * i + 0.5, 0.5, 100}, {0, 0, -1}).instance, std::uint32_t(i + 1));
    EXPECT_EQ(hit_of(*world, {3.0 * i + 0.5, 0.5, 100}, {0, 0, -1}).material, std::uint32_t(i + 2));
    EXPECT_EQ(hit_of(*world, {3.0 * i + 1.5, 0.5, 100}, {0, 0, -1}).instance, 0u);
  }
  EXPECT_TRUE(blocked(*world, {{0.5, 0.5, 0.5}, {0, 0, -1}, 0.4}));
  EXPECT_FALSE(blocked(*world, {{0.5, 0.5, 0.5}, {0, 0, -1}, 0.6}));
}

TEST(World, OfObjectsInOnePlaceTheLastIsMetAndOfItsSurfacesTheFirst) {
  WorldBuilder builder;
  TriangleMesh sheet = test::height_field(6, {});
  const std::size_t triangles = sheet.triangles.size();
  sheet.triangles.insert(sheet.triangles.end(), sheet.triangles.begin(),
                         sheet.triangles.end());  // every facet twice
  const ShapeId id = builder.add_shape(sheet);
  for (int i = 0; i < 3; ++i) builder.place(id, {}, kOne);  // and thrice as instances
  const auto world = builder.build(1);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const SurfacePoint hit =
        hit_of(*world, {5 * test::uniform(12, 2 * i) - 2.5, 5 * test::uniform(12, 2 * i + 1) - 2.5, 9},
               {0.02, 0.05, -1});
    ASSERT_TRUE(hit.hit());
    EXPECT_EQ(hit.instance, 2u);
    EXPECT_LT(hit.primitive, triangles);
    EXPECT_LT(hit.shared_with, 2u);
  }
}

TEST(World, ARoadInAPlaneIsMetFromAllSidesAndWhereverTheyLie) {
  // Far from the origin and aslant: both distances are rounded, each in its own way.
  for (const double z : {0.0, 0.1, 431.7}) {
    WorldBuilder builder;
    builder.place(builder.add_shape(geometry::Plane{}), Transform::translation({0.0, 0.0, z}), kOne);
    const ShapeId road = builder.add_shape(Polygon{{{-3, -1, 0}, {3, -1, 0}, {3, 1, 0}, {-3, 1, 0}}});
    const ShapeId marking =
        builder.add_shape(Polygon{{{-3, -0.1, 0}, {3, -0.1, 0}, {3, 0.1, 0}, {-3, 0.1, 0}}});
    builder.place(road, Transform::translation({5210.3, 77.7, z}), kOne);
    builder.place(builder.add_shape(Box{{-1, -1, 0}, {1, 1, 3}}), Transform::translation({-5000.1, 0, z}),
                  kOne);
    builder.place(marking, Transform::translation({5210.3, 77.7, z}), kOne);
    const auto world = builder.build(1);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Vec3 direction{test::uniform(3, 4 * i) - 0.5, test::uniform(3, 4 * i + 1) - 0.5, -0.3};
      const math::Point3 on{5210.3 + 5.0 * test::uniform(3, 4 * i + 2) - 2.5,
                            77.7 + 1.9 * test::uniform(3, 4 * i + 3) - 0.95, z};
      if (std::abs(std::abs(on.y - 77.7) - 0.1) < 1e-6) continue;
      const SurfacePoint hit = hit_of(*world, on - direction * 100.0, direction);
      ASSERT_EQ(hit.instance, std::abs(on.y - 77.7) < 0.1 ? 3u : 1u);
      ASSERT_LT(hit.shared_with, hit.instance);
    }
    EXPECT_EQ(hit_of(*world, {5300, 0, 500 + z}, {0, 0, -1}).instance, 0u);
    EXPECT_EQ(hit_of(*world, {5300, 0, 500 + z}, {0, 0, -1}).shared_with, geometry::kNoMaterial);
    EXPECT_EQ(world->heights().high_m, 3.0 + z);
    EXPECT_EQ(world->heights().low_m, z);
  }
}

TEST(World, HeightsHoldPlanesAndBoundsDoNot) {
  WorldBuilder builder;
  builder.place(builder.add_shape(Box{{0, 0, -2}, {1, 1, -1}}), {}, kOne);
  builder.place(builder.add_shape(geometry::Plane{100.0}), {}, kOne);
  const auto world = builder.build(1);
  EXPECT_EQ(world->bounds().high_m.z, -1.0);
  EXPECT_EQ(world->heights().low_m, -2.0);
  EXPECT_EQ(world->heights().high_m, 100.0);
}

TEST(World, InputIsChecked) {
  WorldBuilder builder;
  EXPECT_THROW(builder.add_shape(Sphere{{}, -1.0}), InputError);
  EXPECT_THROW(builder.add_shape(Box{{0, 0, 0}, {1, 0, 1}}), InputError);
  EXPECT_THROW(builder.add_shape(Disk{{}, std::nan("")}), InputError);
  EXPECT_THROW(builder.add_shape(Polygon{{{0, 0, 0}, {1, 0, 0}}}), InputError);
  EXPECT_THROW(builder.add_shape(Polygon{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}), InputError);
  EXPECT_THROW(builder.add_shape(Polygon{{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}}), InputError);
  EXPECT_THROW(builder.add_shape(TriangleMesh{}), InputError);
  TriangleMesh mesh = test::height_field(2, {});
  mesh.triangles[3][1] = 99;
  EXPECT_THROW(builder.add_shape(mesh), InputError);
  const ShapeId plane = builder.add_shape(Plane{}), sphere = builder.add_shape(Sphere{});
  EXPECT_THROW(builder.place(plane, Transform::rotation({1, 0, 0}, 0.1), kOne), InputError);
  EXPECT_THROW(builder.place(sphere, Transform::scaling({1, 1, 0}), kOne), InputError);
  EXPECT_THROW(builder.place(sphere, {}, {}), InputError);
  EXPECT_THROW(builder.place(ShapeId{12}, {}, kOne), InputError);
  const Part part{plane, {}, {}};
  EXPECT_THROW(builder.add_prototype({&part, 1}), InputError);
}

}  // namespace
}  // namespace ifov::geometry::test_world
