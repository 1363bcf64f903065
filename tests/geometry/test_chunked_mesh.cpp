// Large meshes, whose trees are made chunk by chunk as rays come near: rays meet what they would meet in one tree.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "core/call_scope.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/mesh_chunks.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_chunked_mesh {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

constexpr std::size_t kBatch = 256;
constexpr int kCells = 300;

/// Hills of several chunks, with materials, normals and texture coordinates.
TriangleMesh hills() {
  TriangleMesh mesh = test::height_field(kCells, {30.0, -20.0, 5.0});
  mesh.slot_names = {"grass", "rock"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.slots.push_back(t / 100 % 2 == 0 ? 0u : 1u);
  for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
    mesh.normals.push_back(math::as_normal(
        math::normalized({0.3 * test::uniform(8, 2 * v), 0.3 * test::uniform(8, 2 * v + 1), 1.0})));
    mesh.uvs.push_back({test::uniform(9, 2 * v), test::uniform(9, 2 * v + 1)});
  }
  return mesh;
}

std::vector<Ray> rays_about(Point3 centre, double reach_m, std::uint64_t key) {
  std::vector<Ray> rays;
  for (std::uint64_t k = 0; k < 12000; ++k) {
    const Point3 to =
        centre + Vec3{(test::uniform(key, 3 * k) - 0.5) * reach_m,
                      (test::uniform(key, 3 * k + 1) - 0.5) * reach_m, 3.0 * test::uniform(key, 3 * k + 2)};
    Vec3 d = test::direction(key + 1, k);
    d.z = -std::abs(d.z) - 0.02;
    d = math::normalized(d);
    // Some begin among the hills, some end there.
    rays.push_back({to - d * (k % 3 == 0 ? 5.0 : 900.0), d});
    if (k % 5 == 0) rays.back().t_max_m = 900.5;
  }
  return rays;
}

struct Answers {
  std::vector<SurfacePoint> hits;
  std::vector<std::uint8_t> blocked;
};

Answers answers_of(const World& world, const std::vector<Ray>& rays, int threads = 1) {
  Answers answers{std::vector<SurfacePoint>(rays.size()), std::vector<std::uint8_t>(rays.size())};
  parallel_for(static_cast<std::int64_t>((rays.size() + kBatch - 1) / kBatch), threads, [&](std::int64_t b) {
    const std::size_t begin = static_cast<std::size_t>(b) * kBatch,
                      count = std::min(kBatch, rays.size() - begin);
    const auto some = std::span(rays).subspan(begin, count);
    world.occluded(some, std::span(answers.blocked).subspan(begin, count));
    world.intersect(some, std::span(answers.hits).subspan(begin, count));
  });
  return answers;
}

bool same(const SurfacePoint& a, const SurfacePoint& b) {
  if (a.hit() != b.hit()) return false;
  if (!a.hit()) return true;
  return a.position_m == b.position_m && a.geometric_normal == b.geometric_normal &&
         a.shading_normal == b.shading_normal && a.distance_m == b.distance_m && a.u == b.u && a.v == b.v &&
         a.instance == b.instance && a.patch == b.patch && a.material == b.material &&
         a.primitive == b.primitive && a.front == b.front && a.offset_m == b.offset_m;
}

std::size_t differences(const Answers& a, const Answers& b) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < a.hits.size(); ++k)
    found += !same(a.hits[k], b.hits[k]) || a.blocked[k] != b.blocked[k] ? 1 : 0;
  return found;
}

std::size_t met(const Answers& answers) {
  return static_cast<std::size_t>(
      std::count_if(answers.hits.begin(), answers.hits.end(), [](const SurfacePoint& h) { return h.hit(); }));
}

std::unique_ptr<World> one_placed(const Body& body, const Transform& where, LargeMeshes how) {
  WorldBuilder builder;
  const std::vector<std::uint32_t> materials{4, 7};
  builder.place(builder.add_shape(Box{{-3.0, -3.0, 0.0}, {3.0, 3.0, 9.0}}), where,
                std::span(materials).first(1));
  builder.place(builder.add_body(body), where, materials);
  return builder.build({.large_meshes = how});
}

std::unique_ptr<World> many_placed(const Body& body, LargeMeshes how, InstanceStorage storage) {
  WorldBuilder builder;
  const std::vector<std::uint32_t> materials{4, 7};
  const ShapeId shape = builder.add_body(body);
  for (int k = 0; k < 3; ++k)
    builder.place(shape,
                  Transform::translation({150.0 * k - 100.0, 40.0 * k, 2.0 * k}) *
                      Transform::rotation({0.1, 0.2, 1.0}, 0.4 * k) *
                      Transform::scaling({1.0, 1.0 - 0.2 * k, 1.2}),
                  materials);
  return builder.build({.instances = storage, .large_meshes = how});
}

TEST(MeshChunks, HoldEveryTriangleOnceAndLieTogether) {
  TriangleMesh mesh = hills();
  const std::size_t count = mesh.triangles.size();
  const MeshLists lists = body_of(std::move(mesh)).mesh;
  ASSERT_EQ(lists.chunks.size(), (count + kMostInChunk - 1) / kMostInChunk);
  ASSERT_GE(lists.chunks.size(), 3u);
  std::vector<std::uint32_t> order(lists.order.begin(), lists.order.end());
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(order, all);
  double covered = 0.0;
  std::size_t end = 0;
  for (const MeshChunk& chunk : lists.chunks) {
    EXPECT_EQ(chunk.first, end);
    EXPECT_LE(chunk.count, kMostInChunk);
    EXPECT_GT(chunk.count, kMostInChunk / 2);
    end += chunk.count;
    const auto [low, high] = chunk.bounds;
    covered += (high.x - low.x) * (high.y - low.y);
    for (const std::uint32_t t : lists.order.subspan(chunk.first, chunk.count))
      for (const std::uint32_t i : lists.triangles[t]) {
        const Point3 p = lists.vertices_m[i];
        ASSERT_TRUE(p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
                    p.z <= high.z);
      }
  }
  EXPECT_EQ(end, count);
  EXPECT_LT(covered, 1.1 * kCells * kCells) << "boxes of chunks of a plain overlap little";
}

TEST(MeshChunks, SmallMeshesAreNotDivided) {
  EXPECT_TRUE(body_of(test::height_field(100, {})).mesh.chunks.empty());
}

TEST(ChunkedMesh, RaysMeetWhatTheyMeetInOneTree) {
  const Body body = body_of(hills());
  for (const Vec3 at : {Vec3{}, Vec3{500000.25, -4000000.5, 100.0}}) {
    const Transform where = Transform::translation(at);
    const std::vector<Ray> rays = rays_about(where(Point3{30.0, -20.0, 5.0}), 1.1 * kCells, 21);
    const auto whole = one_placed(body, where, LargeMeshes::at_once),
               parts = one_placed(body, where, LargeMeshes::by_chunk);
    EXPECT_EQ(whole->storage().chunks, 0u);
    EXPECT_EQ(parts->storage().chunks, body.mesh.chunks.size());
    EXPECT_EQ(parts->storage().stored_triangles, body.mesh.triangles.size());
    EXPECT_EQ(parts->storage().chunks_made, 0u);
    EXPECT_EQ(whole->bounds().low_m, parts->bounds().low_m);
    EXPECT_EQ(whole->bounds().high_m, parts->bounds().high_m);
    const Answers expected = answers_of(*whole, rays);
    EXPECT_GT(met(expected), rays.size() / 2);
    EXPECT_LT(met(expected), rays.size());
    EXPECT_EQ(differences(answers_of(*parts, rays), expected), 0u);
    const World::Storage after = parts->storage();
    EXPECT_EQ(after.chunks_made, after.chunks);
    EXPECT_GT(after.chunk_bytes, 60 * body.mesh.triangles.size());
    EXPECT_LT(after.chunk_bytes, 200 * body.mesh.triangles.size());
  }
}

TEST(ChunkedMesh, SoDoRaysIntoCopies) {
  const Body body = body_of(hills());
  const std::vector<Ray> rays = rays_about({80.0, 20.0, 5.0}, 1.3 * kCells, 31);
  const Answers expected = answers_of(*many_placed(body, LargeMeshes::at_once, InstanceStorage::nodes), rays);
  EXPECT_GT(met(expected), rays.size() / 4);
  for (const InstanceStorage storage : {InstanceStorage::nodes, InstanceStorage::table})
    EXPECT_EQ(differences(answers_of(*many_placed(body, LargeMeshes::by_chunk, storage), rays), expected),
              0u);
}

TEST(ChunkedMesh, AJoinedPrototypeIsDividedToo) {
  const auto world_of = [&](LargeMeshes how) {
    WorldBuilder builder;
    const ShapeId shape = builder.add_shape(hills());
    const std::vector<Part> parts{{shape, {}, {0, 1}},
                                  {shape, Transform::translation({0.0, 0.0, 40.0}), {1, 0}}};
    const std::vector<std::uint32_t> materials{4, 7};
    builder.place(builder.add_prototype(parts), {}, materials);
    return builder.build({.large_meshes = how});
  };
  const std::vector<Ray> rays = rays_about({30.0, -20.0, 25.0}, 1.1 * kCells, 41);
  const auto parts = world_of(LargeMeshes::by_chunk);
  EXPECT_GT(parts->storage().chunks, body_of(hills()).mesh.chunks.size());
  EXPECT_EQ(differences(answers_of(*parts, rays), answers_of(*world_of(LargeMeshes::at_once), rays)), 0u);
}

TEST(ChunkedMesh, ManyThreadsMayComeToOneChunkAtOnce) {
  const Body body = body_of(hills());
  const std::vector<Ray> rays = rays_about({30.0, -20.0, 5.0}, 1.1 * kCells, 51);
  const Answers expected = answers_of(*one_placed(body, {}, LargeMeshes::by_chunk), rays);
  for (int round = 0; round < 3; ++round)
    ASSERT_EQ(differences(answers_of(*one_placed(body, {}, LargeMeshes::by_chunk), rays, 16), expected), 0u);
}

TEST(ChunkedMesh, WhatIsCancelledMeanwhileLeavesTheTreesWhole) {
  const Body body = body_of(hills());
  const std::vector<Ray> rays = rays_about({30.0, -20.0, 5.0}, 1.1 * kCells, 61);
  const Answers expected = answers_of(*one_placed(body, {}, LargeMeshes::at_once), rays);
  // The call is cancelled before the first tree is made: rays end, the world goes on.
  const auto stopped = one_placed(body, {}, LargeMeshes::by_chunk);
  {
    CancelToken cancel;
    cancel.cancel();
    const Call call{.inputs = {}, .cancel = &cancel};
    const CallScope scope(call);
    std::vector<SurfacePoint> hits(rays.size());
    EXPECT_NO_THROW(stopped->intersect(rays, hits));
  }
  EXPECT_EQ(differences(answers_of(*stopped, rays), expected), 0u);
  // A loop ends by an exception, at any moment, while trees are made within it.
  for (int round = 0; round < 10; ++round) {
    const auto world = one_placed(body, {}, LargeMeshes::by_chunk);
    const auto look = [&](std::int64_t k) {
      if (k == 1) {
        std::this_thread::sleep_for(std::chrono::microseconds(2000 * round));
        throw Cancelled();
      }
      std::vector<SurfacePoint> hits(rays.size());
      world->intersect(rays, hits);
    };
    EXPECT_THROW(parallel_for(2, 2, look), Cancelled);
    ASSERT_EQ(differences(answers_of(*world, rays), expected), 0u) << round;
  }
}

TEST(ChunkedMesh, AChunkInTheWrongPlaceWouldBeSeen) {
  // The twin of the comparisons above: one box of many is a tenth too small.
  Body body = body_of(hills());
  std::vector<MeshChunk> chunks(body.mesh.chunks.begin(), body.mesh.chunks.end());
  MeshChunk& wrong = chunks[1];
  wrong.bounds.high_m.x -= 0.1 * (wrong.bounds.high_m.x - wrong.bounds.low_m.x);
  const std::vector<Ray> rays = rays_about({30.0, -20.0, 5.0}, 1.1 * kCells, 21);
  const Answers expected = answers_of(*one_placed(body, {}, LargeMeshes::at_once), rays);
  body.mesh.chunks = chunks;
  EXPECT_GT(differences(answers_of(*one_placed(body, {}, LargeMeshes::by_chunk), rays), expected),
            rays.size() / 100);
}

TEST(ChunkedMesh, SmallScenesHaveTheirTreesFromTheStart) {
  const Body body = body_of(hills());
  EXPECT_EQ(one_placed(body, {}, LargeMeshes::by_number)->storage().chunks, 0u);
}

/// 0 where rays that come to a chunk for which there is no memory end in an exception.
int trace_without_memory() {
  const auto world = one_placed(body_of(hills()), {}, LargeMeshes::by_chunk);
  const std::vector<Ray> rays = rays_about({30.0, -20.0, 5.0}, 1.1 * kCells, 21);
  std::vector<SurfacePoint> hits(rays.size());
  const rlimit none{1, 1};
  setrlimit(RLIMIT_AS, &none);
  try {
    world->intersect(rays, hits);
  } catch (const std::exception&) {
    return 0;
  }
  return 1;
}

TEST(ChunkedMeshDeathTest, ATreeThatDoesNotFitIntoMemoryIsAnError) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer itself ends where there is no memory";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own, with all its threads
  EXPECT_EXIT(std::_Exit(trace_without_memory()), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ifov::geometry::test_chunked_mesh
