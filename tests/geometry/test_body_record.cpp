#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/body_record.h"
#include "scene_maker.h"

namespace ifov::geometry::test_body_record {
namespace {

std::optional<Body> body_of_bytes(std::vector<std::byte> bytes) {
  const auto kept = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return body_from_record(*kept, kept);
}

template <class T>
std::vector<std::remove_const_t<T>> values(std::span<T> list) {
  return {list.begin(), list.end()};
}

std::vector<std::byte> bytes_of(const Body& body) {
  const BodyRecord record = record_of(body);
  std::vector<std::byte> bytes(record.head.size());
  std::memcpy(bytes.data(), record.head.data(), record.head.size());
  for (const auto& list : record.lists) bytes.insert(bytes.end(), list.begin(), list.end());
  return bytes;
}

Body rich_body() {
  TriangleMesh mesh = test::ball(4, 5, 2.0, {1.0, 2.0, 3.0});
  mesh.slot_names = {"", "roof"};
  mesh.slots.assign(mesh.triangles.size(), 1);
  mesh.slots[3] = 0;
  for (const math::Point3& p : mesh.vertices_m) {
    mesh.normals.push_back(math::as_normal(math::normalized(p - math::Point3{1.0, 2.0, 3.0})));
    mesh.uvs.push_back({p.x, p.y});
  }
  mesh.uv_corners = mesh.triangles;
  return body_of(std::move(mesh));
}

TEST(BodyRecord, ComesBackWhole) {
  const Body body = rich_body();
  const std::optional<Body> back = body_of_bytes(bytes_of(body));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(values(back->mesh.vertices_m), values(body.mesh.vertices_m));
  EXPECT_EQ(values(back->mesh.triangles), values(body.mesh.triangles));
  EXPECT_EQ(values(back->mesh.slots), values(body.mesh.slots));
  EXPECT_EQ(back->mesh.slot_names, body.mesh.slot_names);
  EXPECT_EQ(values(back->mesh.normals), values(body.mesh.normals));
  EXPECT_EQ(values(back->mesh.normal_corners), values(body.mesh.normal_corners));
  EXPECT_EQ(values(back->mesh.uvs), values(body.mesh.uvs));
  EXPECT_EQ(values(back->mesh.uv_corners), values(body.mesh.uv_corners));
  EXPECT_EQ(values(back->mesh.patches), values(body.mesh.patches));
  EXPECT_EQ(back->half_sides_m, body.half_sides_m);
  EXPECT_EQ(back->patch_count, body.patch_count);
  EXPECT_EQ(back->slot_count, body.slot_count);
  EXPECT_EQ(back->surface_triangles, body.surface_triangles);
  EXPECT_EQ(back->bounds.low_m, body.bounds.low_m);
  EXPECT_EQ(back->bounds.high_m, body.bounds.high_m);
  EXPECT_EQ(back->centre_m, body.centre_m);
  EXPECT_EQ(back->radius_m, body.radius_m);
  EXPECT_EQ(back->pilot_point_m, body.pilot_point_m);
  EXPECT_EQ(back->pilot_weight, body.pilot_weight);
  EXPECT_EQ(back->pilot_is_solid, body.pilot_is_solid);
}

TEST(BodyRecord, KeepsChunks) {
  const Body body = body_of(test::height_field(300, {}));
  ASSERT_FALSE(body.mesh.chunks.empty());
  const std::vector<std::byte> good = bytes_of(body);
  const std::optional<Body> back = body_of_bytes(good);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(values(back->mesh.order), values(body.mesh.order));
  EXPECT_EQ(values(back->mesh.chunks), values(body.mesh.chunks));
  // They are the last list: chunks that overlap, leave a gap or reach beyond the end make no sense.
  const std::size_t chunks = good.size() - body.mesh.chunks.size_bytes();
  for (const std::size_t at : {offsetof(MeshChunk, first), offsetof(MeshChunk, count)})
    for (std::size_t k = 0; k < body.mesh.chunks.size(); ++k) {
      std::vector<std::byte> damaged = good;
      damaged[chunks + k * sizeof(MeshChunk) + at] ^= std::byte{1};
      EXPECT_FALSE(body_of_bytes(std::move(damaged)).has_value()) << at << ' ' << k;
    }
  // Neither does a triangle that is not there.
  const std::size_t order = chunks - body.mesh.order.size_bytes();
  for (const std::size_t k : {std::size_t{0}, body.mesh.order.size() - 1}) {
    std::vector<std::byte> damaged = good;
    damaged[order + 4 * k + 3] = std::byte{0x10};
    EXPECT_FALSE(body_of_bytes(std::move(damaged)).has_value()) << k;
  }
}

TEST(BodyRecord, IsNotTrusted) {
  const std::vector<std::byte> good = bytes_of(rich_body());
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(body_of_bytes({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}).has_value())
        << size;
  // Whatever a byte becomes, what comes back can be used: indices are within their lists.
  std::size_t refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::vector<std::byte> damaged = good;
    damaged[at] ^= std::byte{0x80};
    const std::optional<Body> body = body_of_bytes(damaged);
    if (!body) {
      ++refused;
      continue;
    }
    EXPECT_NO_THROW(check_mesh(body->mesh));
    for (const std::uint32_t patch : body->mesh.patches) EXPECT_LT(patch, body->patch_count);
  }
  EXPECT_GT(refused, good.size() / 8);
}

}  // namespace
}  // namespace ifov::geometry::test_body_record
