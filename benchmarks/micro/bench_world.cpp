// Rays per second through geometry::World: fractal-like ground of a million triangles under 10,000 instances
// of a tree of 5,000 triangles. Primary rays come in scan order, shadow rays from where they met something.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/world/world_builder.h"

namespace {

using namespace ifov;

constexpr double kSide_m = 1000.0;
constexpr int kPosts = 707, kTrees = 100, kLeaves = 2450;
constexpr std::size_t kRow = 512;

double uniform(std::uint64_t key, std::uint64_t index) {
  std::uint64_t h = key * 0x9e3779b97f4a7c15ull + index * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

double ground_m(double x, double y) {
  double z = 0.0, amplitude = 20.0, frequency = 0.02;
  for (int octave = 0; octave < 8; ++octave, amplitude *= 0.48, frequency *= 2.03)
    z += amplitude * std::sin(frequency * x + 1.3 * octave) * std::cos(frequency * y + 0.7 * octave);
  return z;
}

geometry::TriangleMesh ground() {
  geometry::TriangleMesh mesh;
  for (int j = 0; j <= kPosts; ++j)
    for (int i = 0; i <= kPosts; ++i) {
      const double x = (double(i) / kPosts - 0.5) * kSide_m, y = (double(j) / kPosts - 0.5) * kSide_m;
      mesh.vertices_m.push_back({x, y, ground_m(x, y)});
    }
  for (std::uint32_t j = 0; j < kPosts; ++j)
    for (std::uint32_t i = 0; i < kPosts; ++i) {
      const std::uint32_t a = j * (kPosts + 1) + i, c = a + kPosts + 1;
      mesh.triangles.push_back({a, a + 1, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  return mesh;
}

/// Leaf cards of 0.35 m by 0.25 m in an ellipsoid, denser towards its surface, over a trunk.
geometry::TriangleMesh tree() {
  geometry::TriangleMesh mesh;
  for (std::uint64_t leaf = 0; leaf < kLeaves; ++leaf) {
    const double z = 2.0 * uniform(1, leaf) - 1.0, a = 6.283185 * uniform(2, leaf),
                 r = std::sqrt(1.0 - z * z);
    const double depth = std::pow(uniform(3, leaf), 0.25);
    const math::Point3 centre{3.5 * depth * r * std::cos(a), 3.5 * depth * r * std::sin(a),
                              7.0 + 4.0 * depth * z};
    const math::Transform turn =
        math::Transform::rotation({uniform(4, leaf) - 0.5, uniform(5, leaf) - 0.5, uniform(6, leaf) - 0.5},
                                  6.283185 * uniform(7, leaf));
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const math::Vec3 d :
         {math::Vec3{-0.175, -0.125, 0}, {0.175, -0.125, 0}, {0.175, 0.125, 0}, {-0.175, 0.125, 0}})
      mesh.vertices_m.push_back(centre + turn(d));
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int ring = 0; ring <= 5; ++ring)
    for (int k = 0; k < 10; ++k)
      mesh.vertices_m.push_back(
          {0.2 * std::cos(0.6283185 * k), 0.2 * std::sin(0.6283185 * k), -0.5 + 1.2 * ring});
  for (std::uint32_t ring = 0; ring < 5; ++ring)
    for (std::uint32_t k = 0; k < 10; ++k) {
      const std::uint32_t a = base + ring * 10 + k, b = base + ring * 10 + (k + 1) % 10;
      mesh.triangles.push_back({a, b, b + 10});
      mesh.triangles.push_back({a, b + 10, a + 10});
    }
  return mesh;
}

const geometry::World& forest() {
  static const std::unique_ptr<geometry::World> world = [] {
    geometry::WorldBuilder builder;
    const std::array<std::uint32_t, 1> soil{0}, leaf{1};
    const geometry::ShapeId field = builder.add_shape(ground()), one_tree = builder.add_shape(tree());
    builder.place(field, {}, soil);
    for (std::uint64_t n = 0; n < kTrees * kTrees; ++n) {
      const double step = kSide_m / kTrees;
      const double x = -kSide_m / 2 + (double(n % kTrees) + uniform(8, n)) * step;
      const double y = -kSide_m / 2 + (double(n / kTrees) + uniform(9, n)) * step,
                   size = 0.8 + 0.5 * uniform(10, n);
      builder.place(one_tree,
                    math::Transform::translation({x, y, ground_m(x, y)}) *
                        math::Transform::rotation({0, 0, 1}, 6.283185 * uniform(11, n)) *
                        math::Transform::scaling({size, size, size}),
                    leaf);
    }
    return builder.build();
  }();
  return *world;
}

/// A row of a pushbroom scanner at 3 km, one ray in each of the pixels of 0.5 m.
std::vector<math::Ray> row(std::uint64_t line) {
  std::vector<math::Ray> rays;
  for (std::uint64_t k = 0; k < kRow; ++k) {
    const double y = (double(line % kRow) / kRow - 0.5) * 0.9 * kSide_m;
    const math::Point3 from{0.0, y, 3000.0};
    const math::Point3 to{((double(k) + uniform(12, line * kRow + k)) / kRow - 0.5) * 0.9 * kSide_m, y, 0.0};
    rays.push_back({from, math::normalized(to - from)});
  }
  return rays;
}

std::vector<math::Ray> shadow_rays(const geometry::World& world, const std::vector<math::Ray>& rays) {
  std::vector<geometry::SurfacePoint> hits(rays.size());
  world.intersect(rays, hits);
  const math::Vec3 sun = math::normalized({0.4, -0.4, 0.8});
  std::vector<math::Ray> leaving;
  for (const geometry::SurfacePoint& hit : hits) {
    const math::Vec3 n = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (hit.hit() && dot(n, sun) > 0.0) leaving.push_back({hit.position_m + n * hit.offset_m, sun});
  }
  return leaving;
}

void intersect_primary(benchmark::State& state) {
  const geometry::World& world = forest();
  std::vector<geometry::SurfacePoint> hits(kRow);
  std::int64_t rays_done = 0;
  std::uint64_t line = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::vector<math::Ray> rays = row(line++);
    state.ResumeTiming();
    world.intersect(rays, hits);
    rays_done += static_cast<std::int64_t>(rays.size());
    for (const geometry::SurfacePoint& hit : hits)
      if (!hit.hit()) state.SkipWithError("a ray fell through the ground");
  }
  state.SetItemsProcessed(rays_done);
}

void occlude_sun(benchmark::State& state) {
  const geometry::World& world = forest();
  std::vector<std::uint8_t> blocked(kRow);
  std::int64_t rays_done = 0, in_shadow = 0;
  std::uint64_t line = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::vector<math::Ray> rays = shadow_rays(world, row(line++));
    state.ResumeTiming();
    world.occluded(rays, {blocked.data(), rays.size()});
    rays_done += static_cast<std::int64_t>(rays.size());
    for (std::size_t k = 0; k < rays.size(); ++k) in_shadow += blocked[k];
  }
  const double share = double(in_shadow) / double(rays_done);
  if (share < 0.2 || share > 0.8) state.SkipWithError("an unlikely share of shadow");
  state.SetItemsProcessed(rays_done);
}

BENCHMARK(intersect_primary)->Unit(benchmark::kMicrosecond)->MinTime(1.0);
BENCHMARK(occlude_sun)->Unit(benchmark::kMicrosecond)->MinTime(1.0);

}  // namespace
