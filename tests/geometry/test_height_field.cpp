#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/error.h"
#include "geometry/height_field.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_height_field {
namespace {

using math::Point3;
using math::Ray;
using math::Vec3;

TerrainGrid grid_of(int columns, int rows, const std::function<double(int, int)>& height) {
  TerrainGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.corner_m = {-70.0, 55.0, 120.0};
  grid.along_column_m = {2.0, 0.3, 0.0};
  grid.along_row_m = {0.2, -3.0, 0.0};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) grid.height_m.push_back(static_cast<float>(height(c, r)));
  return grid;
}

double hills(int c, int r) {
  return 14.0 * std::sin(0.21 * c) * std::cos(0.17 * r) + 3.0 * std::sin(1.3 * c + r);
}

std::unique_ptr<World> field_world(TerrainGrid grid, bool smooth, const math::Transform& place = {}) {
  WorldBuilder builder;
  const std::uint32_t materials[] = {5};
  builder.place(builder.add_height_field(std::make_shared<HeightField>(std::move(grid), smooth)), place,
                materials);
  return builder.build(1);
}
std::unique_ptr<World> mesh_world(const TerrainGrid& grid, bool smooth, const math::Transform& place = {}) {
  WorldBuilder builder;
  const std::uint32_t materials[] = {5};
  builder.place(builder.add_shape(mesh_terrain(grid, 0.0, smooth).mesh), place, materials);
  return builder.build(1);
}

/// Rays between two places about the terrain, a third of them grazing.
std::vector<Ray> rays_about(const World& world, int count) {
  const World::Bounds b = world.bounds();
  const Vec3 size = b.high_m - b.low_m;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const auto u = [&](int k) { return test::uniform(77, static_cast<std::uint64_t>(6 * i + k)); };
    const double thin = i % 3 == 0 ? 1.0 : 3.0;
    const auto place = [&](int k) {
      return Point3{b.low_m.x + size.x * (1.4 * u(k) - 0.2), b.low_m.y + size.y * (1.4 * u(k + 1) - 0.2),
                    b.low_m.z + size.z * (0.5 + thin * (u(k + 2) - 0.5))};
    };
    const Point3 from = place(0), to = place(3);
    rays.push_back({from, math::normalized(to - from), 0.0, std::numeric_limits<double>::infinity()});
  }
  return rays;
}

void expect_same(const World& field, const World& mesh, int count) {
  const std::vector<Ray> rays = rays_about(mesh, count);
  std::vector<SurfacePoint> ours(rays.size()), theirs(rays.size());
  field.intersect(rays, ours);
  mesh.intersect(rays, theirs);
  std::vector<std::uint8_t> blocked(rays.size());
  field.occluded(rays, blocked);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(ours[i].hit(), theirs[i].hit()) << i;
    EXPECT_EQ(blocked[i] != 0, theirs[i].hit()) << i;
    if (!ours[i].hit()) continue;
    ++hits;
    EXPECT_NEAR(ours[i].distance_m, theirs[i].distance_m, 1e-7) << i;
    EXPECT_NEAR(dot(ours[i].geometric_normal, theirs[i].geometric_normal.as_vector()), 1.0, 1e-9) << i;
    EXPECT_NEAR(dot(ours[i].shading_normal, theirs[i].shading_normal.as_vector()), 1.0, 1e-9) << i;
    EXPECT_EQ(ours[i].front, theirs[i].front) << i;
    EXPECT_EQ(ours[i].material, 5u);
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_LT(hits, count);
}

TEST(HeightField, IsMetWhereTheMeshOfAllItsHeightsIs) {
  for (const bool smooth : {false, true}) {
    const TerrainGrid grid = grid_of(75, 41, hills);
    expect_same(*field_world(grid, smooth), *mesh_world(grid, smooth), 4000);
  }
}

TEST(HeightField, StandsWhereItIsPlaced) {
  const TerrainGrid grid = grid_of(40, 40, hills);
  const math::Transform place = math::Transform::translation({3.0e5, -2.0e5, 40.0}) *
                                math::Transform::rotation(math::normalized(Vec3{0.2, 0.1, 1.0}), 0.7) *
                                math::Transform::scaling({1.5, -0.8, 2.0});
  expect_same(*field_world(grid, true, place), *mesh_world(grid, true, place), 3000);
}

TEST(HeightField, OtherDiagonalsWouldBeSeen) {
  TerrainGrid shifted = grid_of(75, 41, [](int c, int r) { return hills(c + 1, r); });
  const TerrainGrid grid = grid_of(76, 41, hills);
  shifted.corner_m = shifted.corner_m + shifted.along_column_m;
  const auto mesh = mesh_world(grid, false), field = field_world(shifted, false);
  const std::vector<Ray> rays = rays_about(*mesh, 500);
  std::vector<SurfacePoint> ours(rays.size()), theirs(rays.size());
  field->intersect(rays, ours);
  mesh->intersect(rays, theirs);
  double largest = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (ours[i].hit() && theirs[i].hit())
      largest = std::max(largest, std::abs(ours[i].distance_m - theirs[i].distance_m));
  EXPECT_GT(largest, 0.1);
}

/// Lines through nodes, along sides and along diagonals must not slip through.
TEST(HeightField, IsTight) {
  const TerrainGrid grid = grid_of(50, 50, hills);
  const HeightField field(grid, false);
  const auto world = field_world(grid, false);
  int leaks = 0, rays = 0;
  for (int r = 1; r < 49; ++r)
    for (int c = 1; c < 49; ++c)
      for (const Vec3 tilt : {Vec3{0.0, 0.0, 0.0}, Vec3{0.02, 0.0, 0.0}, Vec3{0.0, 0.03, 0.0},
                              Vec3{0.02, 0.02, 0.0}, Vec3{0.02, -0.02, 0.0}}) {
        // Through the node, in the field's frame, leaning along its axes and diagonals.
        const double z = static_cast<double>(grid.height_m[grid.index(c, r)]);
        const Point3 high = field.object_from_field()(Point3{c + 30.0 * tilt.x, r + 30.0 * tilt.y, z + 30.0});
        const Point3 node = grid.node(c, r);
        const Ray ray{high, math::normalized(node - high), 0.0, std::numeric_limits<double>::infinity()};
        SurfacePoint hit;
        world->intersect({&ray, 1}, {&hit, 1});
        ++rays;
        leaks += hit.hit() && hit.distance_m < math::length(node - high) + 1e-6 ? 0 : 1;
      }
  EXPECT_EQ(rays, 48 * 48 * 5);
  EXPECT_EQ(leaks, 0);
}

TEST(HeightField, UnknownHeightsAreHoles) {
  const TerrainGrid grid = grid_of(
      40, 40, [](int c, int r) { return c > 10 && c < 16 && r > 20 && r < 30 ? std::nan("") : hills(c, r); });
  expect_same(*field_world(grid, false), *mesh_world(grid, false), 3000);
}

TEST(HeightField, LeavesASurfaceWithoutMeetingItAgain) {
  const auto world = field_world(grid_of(60, 60, [](int c, int r) { return 0.5 * c - 0.3 * r; }), false);
  int again = 0;
  for (int i = 0; i < 500; ++i) {
    const Ray down{
        {-70.0 + 0.2 * i, 0.01 * i, 400.0}, {0.0, 0.0, -1.0}, 0.0, std::numeric_limits<double>::infinity()};
    SurfacePoint hit;
    world->intersect({&down, 1}, {&hit, 1});
    if (!hit.hit()) continue;
    const Vec3 n = hit.geometric_normal.as_vector();
    const Vec3 along =
        math::normalized(math::cross(n, {std::sin(0.1 * i), std::cos(0.1 * i), 0.0}) + n * 1e-4);
    const Ray away{hit.position_m + n * hit.offset_m, along, 0.0, std::numeric_limits<double>::infinity()};
    std::uint8_t blocked = 0;
    world->occluded({&away, 1}, {&blocked, 1});
    again += blocked;
  }
  EXPECT_EQ(again, 0);
}

TEST(HeightField, ShadesItselfAsTheMeshDoes) {
  const TerrainGrid grid = grid_of(200, 200, [](int c, int r) {
    return hills(c, r) + 0.6 * test::uniform(5, static_cast<std::uint64_t>(200 * r + c));
  });
  const auto field = field_world(grid, true), mesh = mesh_world(grid, true);
  const std::vector<Ray> rays = rays_about(*mesh, 20000);
  std::vector<SurfacePoint> hits(rays.size());
  mesh->intersect(rays, hits);
  std::vector<Ray> away;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit()) continue;
    const Vec3 n = hits[i].geometric_normal.as_vector() * (hits[i].front ? 1.0 : -1.0);
    Vec3 d = test::direction(9, i);
    if (dot(d, n) < 0.0) d = -d;
    away.push_back(
        {hits[i].position_m + n * hits[i].offset_m, d, 0.0, std::numeric_limits<double>::infinity()});
  }
  std::vector<std::uint8_t> ours(away.size()), theirs(away.size());
  field->occluded(away, ours);
  mesh->occluded(away, theirs);
  int blocked = 0;
  for (std::size_t i = 0; i < away.size(); ++i) {
    blocked += theirs[i];
    EXPECT_EQ(ours[i], theirs[i]) << i;
  }
  EXPECT_GT(blocked, 1000);
}

TEST(HeightField, SaysWhatItCannotTrace) {
  const auto error_of = [](TerrainGrid grid) {
    try {
      HeightField(std::move(grid), true);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(error_of(grid_of(1, 5, hills)), "a terrain needs at least 2 x 2 nodes: found 1 x 5");
  EXPECT_EQ(error_of(grid_of(5, 5, [](int, int) { return std::nan(""); })),
            "the terrain has no triangle with three known heights");
  TerrainGrid bent = grid_of(3, 3, hills);
  bent.positions_m.assign(9, {0.0, 0.0});
  EXPECT_EQ(error_of(std::move(bent)), "a terrain that is traced as a grid must be regular on the map");
  WorldBuilder builder;
  const ShapeId id = builder.add_height_field(std::make_shared<HeightField>(grid_of(4, 4, hills), true));
  const Part part{id, {}, {}};
  EXPECT_THROW(builder.add_prototype({&part, 1}), InputError);
}

}  // namespace
}  // namespace ifov::geometry::test_height_field
