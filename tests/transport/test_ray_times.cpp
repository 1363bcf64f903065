// All rays of a path meet the scene at the time of the ray that the sensor sent.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/periodic_world.h"
#include "materials/bsdf/mirror.h"
#include "transport/mirror_light.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"
#include "transport/timed_world.h"

namespace ifov::test_ray_times {
namespace {

using test::SmallScene;
using test::TimedWorld;

/// Ground and a leaf under the Sun, with a hot ball, a wall and a ball that mirror: every kind of ray is sent.
const transport::SpectralScene& build(SmallScene& scene, TimedWorld::Counts& counts) {
  scene.place(geometry::Plane{}, scene.material(0.5));
  const std::uint32_t mirror = scene.material(0.8, 0.0, materials::Mirror::shared());
  scene.place(geometry::Polygon{{{0.0, -4.0, 0.0}, {0.0, 4.0, 0.0}, {0.0, 4.0, 3.0}, {0.0, -4.0, 3.0}}},
              mirror);
  scene.place(geometry::Sphere{{2.5, -2.0, 0.8}, 0.7}, mirror);
  scene.place(geometry::Sphere{{2.5, 2.0, 2.2}, 0.5}, scene.material(0.0, 900.0));
  scene.place(geometry::Disk{{0.0, 0.0, 0.0}, 0.4}, scene.leaf(0.3, 0.3),
              math::Transform::translation({1.5, 0.5, 1.0}));
  scene.sun({1.0, 0.3, 1.0}, 10.0, 0.005);
  const transport::SpectralScene& built = scene.build([&](std::unique_ptr<geometry::World> world) {
    return std::make_unique<TimedWorld>(std::move(world), counts);
  });
  counts = {};  // of finding emitters and mirrors
  return built;
}

/// Traces paths down onto the scene, in turn at each of the times.
void trace(const transport::SpectralScene& scene, const std::vector<double>& times) {
  constexpr int kAcross = 32;
  std::vector<math::Ray> rays;
  for (int k = 0; k < kAcross * kAcross; ++k)
    rays.push_back(
        {.origin_m = {5.0 * (k % kAcross + 0.5) / kAcross, 8.0 * (k / kAcross + 0.5) / kAcross - 4.0, 9.0},
         .direction = {0.0, 0.0, -1.0},
         .time_s = times[static_cast<std::size_t>(k) % times.size()]});
  std::vector<transport::PathKey> keys;
  for (std::uint32_t k = 0; k < rays.size(); ++k) keys.push_back({3, k});
  transport::TransportOptions options;
  options.mirror_reflections = 4;
  transport::PathTracer tracer(scene, options);
  std::vector<geometry::SurfacePoint> hits(rays.size());
  sampling::RayCounts counts;
  tracer.trace(rays, keys, hits, counts);
}

std::size_t sum(const std::map<double, std::size_t>& counts) {
  std::size_t all = 0;
  for (const auto& [time, count] : counts) all += count;
  return all;
}

TEST(RayTimes, APathKeepsTheTimeOfItsRay) {
  SmallScene scene;
  TimedWorld::Counts counts;
  const transport::SpectralScene& built = build(scene, counts);
  ASSERT_NE(built.emitters(), nullptr);
  ASSERT_NE(built.emitter_mirrors(), nullptr);
  ASSERT_NE(built.sun_mirrors(), nullptr);
  trace(built, {7.5});
  EXPECT_GT(sum(counts.intersected), 3000u);
  EXPECT_GT(sum(counts.occluded), 1000u);
  EXPECT_EQ(counts.intersected[7.5], sum(counts.intersected));
  EXPECT_EQ(counts.occluded[7.5], sum(counts.occluded));
}

TEST(RayTimes, PathsOfOneBatchKeepTheirOwn) {
  SmallScene scene;
  TimedWorld::Counts counts;
  const transport::SpectralScene& built = build(scene, counts);
  trace(built, {-2.0, 0.125});
  EXPECT_EQ(counts.intersected[-2.0] + counts.intersected[0.125], sum(counts.intersected));
  EXPECT_EQ(counts.occluded[-2.0] + counts.occluded[0.125], sum(counts.occluded));
  EXPECT_GT(counts.intersected[-2.0], 1500u);
  EXPECT_GT(counts.intersected[0.125], 1500u);
}

// What mirrors throw onto a surface is asked for at the time of the ray that met it.
TEST(RayTimes, LightOfMirrorsIsAskedForAtTheSameTime) {
  SmallScene scene;
  TimedWorld::Counts counts;
  const transport::SpectralScene& built = build(scene, counts);
  const transport::PathTracer tracer(built, {});
  const auto light = transport::MirrorLight::find(built, tracer.sun_images(), 4);
  ASSERT_NE(light, nullptr);
  const math::Ray down{.origin_m = {1.0, 0.0, 5.0}, .direction = {0.0, 0.0, -1.0}, .time_s = 7.5};
  geometry::SurfacePoint hit;
  scene.scene().world->intersect({&down, 1}, {&hit, 1});
  ASSERT_TRUE(hit.hit());
  light->ask(0, down, hit, {0.0, 0.0, 1.0});
  sampling::RayCounts traced;
  light->answer(traced, [](std::uint32_t, std::uint64_t, bool) {});
  EXPECT_GT(traced.shadow, 0u);
  EXPECT_EQ(counts.intersected[7.5], sum(counts.intersected));
  EXPECT_EQ(counts.occluded[7.5], sum(counts.occluded));
}

// Copies of a world that repeats are met at the time of the ray.
TEST(RayTimes, AWorldThatRepeatsKeepsThem) {
  SmallScene scene;
  TimedWorld::Counts counts;
  scene.place(geometry::Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, scene.material(0.5));
  scene.build([&](std::unique_ptr<geometry::World> world) {
    return std::make_unique<geometry::PeriodicWorld>(std::make_unique<TimedWorld>(std::move(world), counts),
                                                     geometry::PeriodicWorld::Cell{0.0, 0.0, 4.0, 4.0});
  });
  counts = {};
  const math::Ray ray{
      .origin_m = {30.2, 2.5, 1.5}, .direction = math::normalized({-1.0, 0.0, -0.1}), .time_s = 7.5};
  geometry::SurfacePoint hit;
  std::uint8_t blocked = 0;
  scene.scene().world->intersect({&ray, 1}, {&hit, 1});
  scene.scene().world->occluded({&ray, 1}, {&blocked, 1});
  EXPECT_GT(counts.intersected[7.5] + counts.occluded[7.5], 4u) << "several cells";
  EXPECT_EQ(counts.intersected[7.5], sum(counts.intersected));
  EXPECT_EQ(counts.occluded[7.5], sum(counts.occluded));
}

}  // namespace
}  // namespace ifov::test_ray_times
