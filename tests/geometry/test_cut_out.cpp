// Triangles with holes: rays go through these and meet what they would meet if nothing were there.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "geometry/cut_out.h"
#include "geometry/periodic_world.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_cut_out {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

/// A chequer of `cells` x `cells` in the unit square of u and v, or of cells of 0.25 m of the scene.
class Chequer final : public CutOut {
 public:
  explicit Chequer(double cells) : cells_(cells) {}
  bool is_open(Point3 position_m, double u, double v) const override {
    const double a = cells_ > 0.0 ? u * cells_ : position_m.x / 0.25,
                 b = cells_ > 0.0 ? v * cells_ : position_m.y / 0.25;
    return std::fmod(std::abs(std::floor(a) + std::floor(b)), 2.0) == 1.0;
  }

 private:
  double cells_;
};

/// A unit square about the origin, n x n squares of it, with texture coordinates from 0 to 1.
TriangleMesh sheet(int n = 32) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double u = double(i) / n, v = double(j) / n;
      mesh.vertices_m.push_back({u - 0.5, v - 0.5, 0.0});
      mesh.uvs.push_back({u, v});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i), b = a + 1,
                 c = a + static_cast<std::uint32_t>(n) + 1;
      mesh.triangles.push_back({a, b, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  return mesh;
}

constexpr std::uint32_t kGround = 0, kLeaf = 1, kDraped = 2, kBall = 3;

/// Sheets of several sizes that lean to all sides over the ground, many times and once each, and balls between them.
std::unique_ptr<World> forest(const BuildOptions& options, int n = 32) {
  WorldBuilder builder;
  const ShapeId ground = builder.add_shape(Plane{0.0}), leaf = builder.add_shape(sheet(n)),
                ball = builder.add_shape(test::ball(8, 12, 0.4)), other = builder.add_shape(sheet(n));
  builder.place(ground, {}, std::vector{kGround});
  for (std::uint64_t k = 0; k < 60; ++k) {
    const Transform at =
        Transform::translation({8.0 * test::uniform(1, 3 * k) - 4.0, 8.0 * test::uniform(1, 3 * k + 1) - 4.0,
                                0.5 + 3.0 * test::uniform(1, 3 * k + 2)}) *
        Transform::rotation(test::direction(2, k), 1.5) * Transform::scaling({2.0, 1.5, 1.0});
    builder.place(leaf, at, std::vector{kLeaf});
    if (k % 6 == 0) builder.place(ball, at, std::vector{kBall});
  }
  builder.place(other, Transform::translation({0.0, 0.0, 4.5}) * Transform::scaling({8.0, 8.0, 1.0}),
                std::vector{kDraped});
  return builder.build(options);
}

std::vector<Ray> some_rays() {
  std::vector<Ray> rays;
  for (std::uint64_t k = 0; k < 8000; ++k) {
    const Point3 to{9.0 * test::uniform(5, 3 * k) - 4.5, 9.0 * test::uniform(5, 3 * k + 1) - 4.5,
                    4.0 * test::uniform(5, 3 * k + 2)};
    const Vec3 along = test::direction(6, k);
    rays.push_back({to - 12.0 * along, along, 0.0, k % 5 == 0 ? 13.0 : 1e30});
  }
  return rays;
}

/// What rays meet, by following them through closed holes one by one.
SurfacePoint followed(const World& world, Ray ray,
                      const std::vector<std::shared_ptr<const CutOut>>& cut_outs) {
  for (;;) {
    SurfacePoint hit;
    world.intersect_uncut({&ray, 1}, {&hit, 1});
    if (!hit.hit()) return hit;
    const CutOut* cut_out = hit.material < cut_outs.size() ? cut_outs[hit.material].get() : nullptr;
    if (cut_out == nullptr || !cut_out->is_open(hit.position_m, hit.u, hit.v)) return hit;
    ray.t_min_m = hit.distance_m + 1e-7;
  }
}

class CutOuts : public testing::Test {
 protected:
  CutOuts() {
    options_.threads = 1;
    options_.cut_outs = {nullptr, std::make_shared<const Chequer>(9.0), std::make_shared<const Chequer>(0.0)};
  }
  void judge(const World& world) const {
    const std::vector<Ray> rays = some_rays();
    std::vector<SurfacePoint> hits(rays.size()), closed(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    world.intersect(rays, hits);
    world.intersect_uncut(rays, closed);
    world.occluded(rays, blocked);
    std::size_t through = 0, met = 0, edges = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const SurfacePoint expected = followed(world, rays[k], options_.cut_outs);
      if (hits[k].hit() != expected.hit() || std::abs(hits[k].distance_m - expected.distance_m) > 1e-6) {
        ++edges;
        continue;
      }
      EXPECT_EQ(blocked[k] != 0, hits[k].hit()) << k;
      if (!hits[k].hit()) continue;
      EXPECT_EQ(hits[k].material, expected.material) << k;
      EXPECT_EQ(hits[k].instance, expected.instance) << k;
      through += hits[k].distance_m > closed[k].distance_m;
      met += hits[k].material == kLeaf || hits[k].material == kDraped;
    }
    // Two sheets nearer to each other than the step of the reference.
    EXPECT_LE(edges, 2u);
    EXPECT_GT(through, rays.size() / 6);
    EXPECT_GT(met, rays.size() / 6);
  }
  BuildOptions options_;
};

TEST_F(CutOuts, RaysGoOnThroughHoles) { judge(*forest(options_)); }

TEST_F(CutOuts, InATableOfInstancesToo) {
  options_.instances = InstanceStorage::table;
  judge(*forest(options_));
}

TEST_F(CutOuts, InMeshesThatAreBuiltByAndByToo) {
  options_.large_meshes = LargeMeshes::by_chunk;
  const std::unique_ptr<World> world = forest(options_, 192);
  judge(*world);
  EXPECT_GT(world->storage().chunks_made, 0u);
}

TEST_F(CutOuts, InWorldsThatRepeatToo) { judge(PeriodicWorld(forest(options_), {-6.0, -6.0, 12.0, 12.0})); }

TEST_F(CutOuts, AreasOfHolesAreHalfOfAChequer) {
  WorldBuilder builder;
  builder.place(builder.add_shape(sheet()), {}, std::vector{kLeaf});
  options_.cut_outs[kLeaf] = std::make_shared<const Chequer>(10.0);
  const std::unique_ptr<World> world = builder.build(options_);
  std::vector<Ray> rays;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i)
      rays.push_back({{(i + 0.5) / 100.0 - 0.5, (j + 0.5) / 100.0 - 0.5, 1.0}, {0.0, 0.0, -1.0}});
  std::vector<SurfacePoint> hits(rays.size());
  world->intersect(rays, hits);
  std::size_t there = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    there += hits[k].hit();
    const bool open = (k % 100 / 10 + k / 1000) % 2 == 1;
    EXPECT_EQ(hits[k].hit(), !open) << k;
  }
  EXPECT_EQ(there, rays.size() / 2);
  EXPECT_TRUE(world->has_corners(0));
}

TEST_F(CutOuts, WithoutHolesNothingChanges) {
  const std::unique_ptr<World> cut = forest(options_), whole = forest({.threads = 1});
  const std::vector<Ray> rays = some_rays();
  std::vector<SurfacePoint> closed(rays.size()), expected(rays.size());
  cut->intersect_uncut(rays, closed);
  whole->intersect(rays, expected);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(closed[k].distance_m, expected[k].distance_m) << k;
    EXPECT_EQ(closed[k].instance, expected[k].instance) << k;
  }
}

}  // namespace
}  // namespace ifov::geometry::test_cut_out
