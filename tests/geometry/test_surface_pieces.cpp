// What a world tells of its surfaces is what rays meet.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_surface_pieces {
namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

/// A point of the unit shape, and the direction from outside towards it.
void middle_of(PieceKind kind, Point3& at, Vec3& inwards) {
  inwards = {0.0, 0.0, -1.0};
  at = {0.3, 0.25, 0.0};
  if (kind == PieceKind::open_cylinder) at = {0.6, 0.8, 0.4}, inwards = {-0.6, -0.8, 0.0};
  if (kind == PieceKind::ball || kind == PieceKind::hemisphere)
    at = {0.48, 0.64, 0.6}, inwards = {-0.48, -0.64, -0.6};
}

struct Told {
  std::size_t pieces = 0, missed = 0;
  double area_m2 = 0.0;
};

/// Sends a ray at every piece from close by. `moved`: pieces are taken to stand so far aside.
Told look_at(const World& world, const WantedMaterials& wanted, Vec3 moved = {}) {
  Told told;
  world.visit_surfaces(wanted, [&](const SurfacePiece& piece) {
    EXPECT_TRUE(wanted[piece.material]);
    Point3 at;
    Vec3 inwards;
    middle_of(piece.kind, at, inwards);
    const Transform& map = piece.scene_from_unit;
    const bool flat = inwards.z == -1.0;
    const Vec3 along = math::normalized(flat ? math::cross(map.column_y(), map.column_x()) : map(inwards));
    const Point3 target = map(at) + moved;
    const math::Ray ray{target - 1e-3 * along, along};
    SurfacePoint hit;
    world.intersect({&ray, 1}, {&hit, 1});
    const bool same = hit.hit() && hit.instance == piece.object && hit.primitive == piece.primitive &&
                      hit.patch == piece.patch && hit.material == piece.material &&
                      math::length(hit.position_m - target) < 1e-4 && hit.front;
    told.missed += !same;
    ++told.pieces;
    told.area_m2 += area_m2(piece);
  });
  return told;
}

/// Shapes of every kind, a mesh of two slots once and many times, nested prototypes, turned and scaled.
std::unique_ptr<World> world_of_all(LargeMeshes large, InstanceStorage storage) {
  WorldBuilder builder;
  const auto turned = [](double x, double y) {
    return Transform::translation({x, y, 3.0}) * Transform::rotation({0.3, 1.0, 0.2}, 0.8) *
           Transform::scaling({1.5, 1.5, 1.5});
  };
  const std::vector<Shape> shapes{Box{{-1.0, -2.0, 0.0}, {1.0, 1.0, 0.5}},
                                  Sphere{{0.0, 0.0, 1.0}, 0.7},
                                  Hemisphere{{}, 1.0},
                                  Cylinder{{0.0, 0.0, 0.0}, 0.5, 2.0, true},
                                  Cylinder{{}, 0.5, 2.0, false},
                                  Disk{{}, 1.2},
                                  Polygon{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}}}};
  double x = 0.0;
  for (const Shape& shape : shapes) {
    const ShapeId id = builder.add_shape(shape);
    builder.place(id, turned(x += 10.0, 0.0), std::vector<std::uint32_t>(builder.slot_count(id), 0));
  }
  TriangleMesh ball = test::ball(8, 12, 1.0);
  ball.slot_names = {"a", "b"};
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) ball.slots.push_back(t % 2);
  const ShapeId mesh = builder.add_shape(ball);
  const std::vector<std::uint32_t> slots{0, 1};
  for (int k = 0; k < 4; ++k) builder.place(mesh, turned(10.0 * k, 20.0), slots);
  const ShapeId sphere = builder.add_shape(Sphere{{}, 0.5});
  const std::vector<Part> parts{{mesh, Transform::translation({0.0, 0.0, 2.0}), {0, 1}},
                                {sphere, Transform::translation({2.0, 0.0, 0.0}), {1}},
                                {builder.add_shape(Box{{0, 0, 0}, {1, 1, 1}}), {}, {0}}};
  const ShapeId prototype = builder.add_prototype(parts);
  for (int k = 0; k < 3; ++k) builder.place(prototype, turned(10.0 * k, 40.0), slots);
  const ShapeId hills = builder.add_shape(test::height_field(60, {0.0, -60.0, 0.0}));
  builder.place(hills, {}, std::vector<std::uint32_t>{2});
  builder.place(builder.add_shape(Plane{-20.0}), {}, std::vector<std::uint32_t>{3});
  return builder.build(BuildOptions{1, storage, large});
}

TEST(SurfacePieces, RaysMeetWhatTheWorldTells) {
  for (const LargeMeshes large : {LargeMeshes::at_once, LargeMeshes::by_chunk})
    for (const InstanceStorage storage : {InstanceStorage::nodes, InstanceStorage::table}) {
      const auto world = world_of_all(large, storage);
      const Told all = look_at(*world, {true, true, true, true});
      EXPECT_EQ(all.missed, 0u);
      const std::size_t ball = 2 * 12 * 7;
      EXPECT_EQ(all.pieces, 6u + 1 + 1 + 3 + 1 + 1 + 2 + 4 * ball + 3 * (ball + 1 + 6) + 2 * 60 * 60);
      const Told one = look_at(*world, {false, true, false, false});
      EXPECT_EQ(one.pieces, 4 * ball / 2 + 3 * (ball / 2 + 1));
      EXPECT_EQ(one.missed, 0u);

      const std::vector<double> areas = world->surface_areas_m2(4);
      EXPECT_NEAR(areas[0] + areas[1] + areas[2], all.area_m2, 1e-6 * all.area_m2);
      EXPECT_NEAR(areas[1], one.area_m2, 1e-6 * areas[1]);
      EXPECT_GE(areas[3], all.area_m2);
    }
}

TEST(SurfacePieces, PlantedFaultPiecesBesideTheirPlaceAreMissed) {
  const auto world = world_of_all(LargeMeshes::at_once, InstanceStorage::nodes);
  EXPECT_GT(look_at(*world, {true, true, true, true}, {0.0, 0.01, 0.02}).missed, 100u);
}

TEST(SurfacePieces, AreasOfSolidsAreTheirs) {
  WorldBuilder builder;
  builder.place(builder.add_shape(Box{{0, 0, 0}, {1, 2, 3}}), {}, std::vector<std::uint32_t>{0});
  builder.place(builder.add_shape(Sphere{{}, 2.0}), Transform::translation({9, 0, 0}),
                std::vector<std::uint32_t>{1});
  builder.place(builder.add_shape(Cylinder{{}, 1.0, 3.0, true}), Transform::translation({0, 9, 0}),
                std::vector<std::uint32_t>{2});
  const std::vector<double> areas = builder.build(1)->surface_areas_m2(3);
  EXPECT_NEAR(areas[0], 22.0, 1e-9);
  EXPECT_NEAR(areas[1], 16.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(areas[2], 8.0 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace ifov::geometry::test_surface_pieces
