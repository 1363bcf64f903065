// Prototypes, material slots, attributes of meshes, and the list of objects.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_world_builder {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

using Slots = std::vector<std::uint32_t>;

SurfacePoint hit_of(const World& world, Point3 from, Vec3 along) {
  const Ray ray{from, normalized(along)};
  SurfacePoint hit;
  world.intersect({&ray, 1}, {&hit, 1});
  return hit;
}

TEST(WorldBuilder, PrototypesOfPrototypesBecomeOneLevel) {
  WorldBuilder builder;
  const ShapeId leaf = builder.add_shape(Disk{{}, 0.4}),
                trunk = builder.add_shape(Cylinder{{}, 0.2, 2.0, true});
  const ShapeId block = builder.add_shape(test::ball(8, 12, 0.3));
  // A twig of three leaves and a ball; a tree of a trunk and four twigs; a forest of trees.
  const std::vector<Part> twig_parts{{leaf, Transform::translation({0, 0, 0.5}), {0}},
                                     {leaf, Transform::translation({1, 0, 0.5}), {0}},
                                     {leaf, Transform::translation({2, 0, 0.5}), {0}},
                                     {block, Transform::translation({3, 0, 0}), {1}}};
  const ShapeId twig = builder.add_prototype(twig_parts);
  EXPECT_EQ(builder.slot_count(twig), 2u);
  std::vector<Part> tree_parts{{trunk, {}, {2}}};
  for (int k = 0; k < 4; ++k)
    tree_parts.push_back(
        {twig,
         Transform::rotation({0, 0, 1}, k * std::numbers::pi / 2) * Transform::translation({1, 0, 3}),
         {0, 1}});
  const ShapeId tree = builder.add_prototype(tree_parts);
  EXPECT_EQ(builder.slot_count(tree), 3u);
  for (std::uint32_t k = 0; k < 10; ++k)
    EXPECT_EQ(
        builder.place(tree, Transform::translation({20.0 * k, 5e5, 0}), Slots{100 + k, 200 + k, 300 + k}), k);
  const auto world = builder.build(1);
  EXPECT_EQ(world->object_count(), 10u);

  for (std::uint32_t k = 0; k < 10; ++k) {
    std::vector<std::uint32_t> patches, primitives;
    for (int arm = 0; arm < 4; ++arm) {
      const double c = std::round(std::cos(arm * std::numbers::pi / 2)),
                   s = std::round(std::sin(arm * std::numbers::pi / 2));
      for (int at = 1; at <= 4; ++at) {
        const SurfacePoint hit =
            hit_of(*world, {20.0 * k + at * c + 0.05, 5e5 + at * s + 0.02, 700e3}, {0, 0, -1});
        ASSERT_TRUE(hit.hit());
        EXPECT_EQ(hit.instance, k);
        EXPECT_EQ(hit.material, at < 4 ? 100 + k : 200 + k);
        patches.push_back(hit.patch);
        primitives.push_back(hit.primitive);
      }
    }
    // Every leaf and every ball has a patch of its own within the tree.
    std::sort(patches.begin(), patches.end());
    EXPECT_EQ(std::unique(patches.begin(), patches.end()) - patches.begin(), 16);
    std::sort(primitives.begin(), primitives.end());
    EXPECT_EQ(std::unique(primitives.begin(), primitives.end()) - primitives.begin(), 16);
    EXPECT_EQ(hit_of(*world, {20.0 * k - 5, 5e5, 1}, {1, 0, 0}).material, 300 + k);
  }
}

TEST(WorldBuilder, OneCopyAndManyGiveTheSameHits) {
  const TriangleMesh mesh = test::ball(12, 16, 2.0);
  const Transform map = Transform::translation({100, 50, 7}) * Transform::rotation({1, 1, 0}, 0.4) *
                        Transform::scaling({1, 2, -1.5});
  WorldBuilder one, many;
  one.place(one.add_shape(mesh), map, Slots{3});
  const ShapeId id = many.add_shape(mesh);
  many.place(id, map, Slots{3});
  many.place(id, Transform::translation({90, 50, 7}), Slots{3});
  const auto a = one.build(1), b = many.build(1);
  int met = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vec3 d = test::direction(70, i);
    const Point3 from = Point3{100, 50, 7} + test::direction(71, i) * 1.5 - d * 6.0;
    const SurfacePoint p = hit_of(*a, from, d), q = hit_of(*b, from, d);
    if (!p.hit() || q.instance != 0) continue;
    ++met;
    ASSERT_EQ(p.primitive, q.primitive);
    EXPECT_EQ(p.patch, q.patch);
    EXPECT_EQ(p.front, q.front);
    EXPECT_TRUE(p.front);  // though the map mirrors
    EXPECT_LT(length(p.position_m - q.position_m), 1e-10);
    EXPECT_NEAR(dot(p.geometric_normal, q.geometric_normal.as_vector()), 1.0, 1e-12);
  }
  EXPECT_GT(met, 500);
}

TEST(WorldBuilder, VertexNormalsAndTextureAreInterpolated) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  mesh.slots = {0, 1};
  mesh.slot_names = {"lower", "upper"};
  mesh.normals = {math::as_normal(math::normalized({-1, 0, 1})),
                  math::as_normal(math::normalized({1, 0, 1})),
                  {0, 0, -1}};
  mesh.normal_corners = {{0, 1, 0}, {2, 2, 2}};
  mesh.uvs = {{0, 0}, {2, 0}, {0, 3}};
  mesh.uv_corners = {{0, 1, 2}, {kNoIndex, kNoIndex, kNoIndex}};
  for (const bool instanced : {false, true}) {
    WorldBuilder builder;
    const ShapeId id = builder.add_shape(mesh), pair = builder.add_prototype(std::vector<Part>{
                                                    {id, {}, {0, 1}},
                                                    {id, Transform::translation({0, 5, 0}), {0, 1}},
                                                    {id, Transform::translation({0, 9, 0}), {0, 1}}});
    const Transform map = Transform::translation({3e5, 4e5, 10}) * Transform::scaling({2, 2, 1});
    builder.place(pair, map, Slots{5, 6});
    if (instanced) builder.place(pair, Transform::translation({3e5 - 50, 4e5, 0}), Slots{5, 6});
    const auto world = builder.build(1);
    for (const double part : {0.0, 10.0, 18.0}) {
      const SurfacePoint hit = hit_of(*world, {3e5 + 0.5, 4e5 + part + 0.5, 50}, {0, 0, -1});
      EXPECT_EQ(hit.material, 5u);
      EXPECT_NEAR(hit.u, 0.5, 1e-9);
      EXPECT_NEAR(hit.v, 0.75, 1e-9);
      EXPECT_NEAR(hit.geometric_normal.z, 1.0, 1e-15);
      // Halfway from -45 to +45 degrees at a quarter of the way: (-0.5, 0, 1) by weights, squeezed by the
      // scale.
      const Vec3 expected = math::normalized({-0.25, 0, 1});
      EXPECT_NEAR(dot(hit.shading_normal, expected), 1.0, 1e-9);
      const SurfacePoint upper = hit_of(*world, {3e5 + 1.5, 4e5 + part + 1.5, 50}, {0, 0, -1});
      EXPECT_EQ(upper.material, 6u);
      EXPECT_EQ(upper.u, 0.0);
      EXPECT_NEAR(upper.shading_normal.z, 1.0, 1e-15);  // turned to the geometric normal's side
    }
  }
}

TEST(WorldBuilder, ObjectsTellWhereTheyAre) {
  WorldBuilder builder;
  const Slots one{0};
  const Transform at = Transform::translation({10, 20, 5}) * Transform::rotation({0, 0, 1}, 0.3) *
                       Transform::scaling({2, 2, 2});
  builder.place(builder.add_shape(Plane{}), {}, one);
  builder.place(builder.add_shape(Sphere{{1, 0, 0}, 1.5}), at, one);
  builder.place(builder.add_shape(Hemisphere{{}, 1.0}), at, one);
  builder.place(builder.add_shape(Cylinder{{}, 0.1, 5.0, false}), at, one);
  TriangleMesh sheet = test::height_field(4, {});
  builder.place(builder.add_shape(sheet), at, one);
  builder.place(builder.add_shape(test::ball(10, 16, 1.0)), at, one);
  builder.place(builder.add_shape(Disk{{}, 0.01}), at, one, false);
  const auto world = builder.build(1);
  ASSERT_EQ(world->object_count(), 7u);
  std::vector<World::PlacedObject> objects;
  for (std::size_t k = 0; k < 7; ++k) objects.push_back(world->object(k));
  EXPECT_FALSE(objects[0].compact);
  EXPECT_TRUE(std::isinf(objects[0].radius_m));
  EXPECT_NEAR(objects[1].radius_m, 3.0, 1e-12);
  EXPECT_LT(length(objects[1].centre_m - at(Point3{1, 0, 0})), 1e-12);
  EXPECT_NEAR(objects[2].radius_m, 2.0, 1e-12);
  EXPECT_NEAR(objects[5].radius_m, 2.0, 0.01);
  EXPECT_FALSE(objects[6].compact);
  for (std::size_t k = 1; k < 6; ++k) EXPECT_TRUE(objects[k].compact);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(world->has_corners(k), k == 3 || k == 4 || k == 5) << k;
}

/// A ray towards the pilot point of an object that stands alone meets the object, from every side that sees a
/// surface there.
TEST(WorldBuilder, PilotPointsAreMet) {
  TriangleMesh ring = test::height_field(6, {});
  const std::vector<std::pair<const char*, Shape>> shapes{
      {"sphere", Sphere{{3, 2, 1}, 0.5}},
      {"box", Box{{0, 0, 0}, {1, 2, 3}}},
      {"hemisphere", Hemisphere{{}, 1.0}},
      {"cylinder", Cylinder{{}, 0.1, 5.0, true}},
      {"sheet", ring},
      {"ball", test::ball(10, 16, 1.0)},
      {"polygon", Polygon{{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}}}}};
  for (const auto& [name, shape] : shapes) {
    SCOPED_TRACE(name);
    WorldBuilder builder;
    builder.place(builder.add_shape(shape), Transform::rotation({1, 0, 0}, 0.2), Slots{0});
    const auto world = builder.build(1);
    const Point3 pilot = world->object(0).pilot_point_m;
    EXPECT_LE(length(pilot - world->object(0).centre_m), world->object(0).radius_m);
    for (std::uint64_t i = 0; i < 200; ++i) {
      Vec3 d = test::direction(72, i);
      d.z = -0.4 - std::abs(d.z);
      d = normalized(d);
      EXPECT_TRUE(hit_of(*world, pilot - d * 500.0, d).hit());
    }
  }
}

TEST(WorldBuilder, BoundsEncloseWhatIsBounded) {
  WorldBuilder builder;
  builder.place(builder.add_shape(Plane{-100}), {}, Slots{0});
  builder.place(builder.add_shape(Sphere{{}, 1.0}), Transform::translation({5e5, 0, 0}), Slots{0});
  builder.place(builder.add_shape(Box{{0, 0, 0}, {1, 1, 1}}), Transform::translation({5e5, 10, 0}), Slots{0});
  const World::Bounds b = builder.build(1)->bounds();
  EXPECT_NEAR(b.low_m.x, 5e5 - 1, 1e-6);
  EXPECT_NEAR(b.high_m.x, 5e5 + 1, 1e-6);
  EXPECT_NEAR(b.low_m.y, -1, 1e-6);
  EXPECT_NEAR(b.high_m.y, 11, 1e-6);
  EXPECT_NEAR(b.low_m.z, -1, 1e-6);
}

}  // namespace
}  // namespace ifov::geometry::test_world_builder
