#include "geometry/body_record.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "geometry/all_pieces.h"

namespace ifov::geometry {
namespace {

constexpr std::size_t kLists = 10;
constexpr std::size_t kMostNames = 1 << 20;

/// What a record begins with.
struct Head {
  std::uint64_t counts[kLists];
  std::uint64_t names, name_bytes, surface_triangles;
  std::uint32_t patch_count, slot_count;
  double low_m[3], high_m[3], centre_m[3], pilot_point_m[3], half_sides_m[3][3];
  double radius_m, pilot_weight;
  std::uint64_t pilot_is_solid;
};
static_assert(std::is_trivially_copyable_v<Head> && sizeof(Head) % 8 == 0);

/// All lists of a body, in a fixed order.
template <class B, class Visit>
void each_list(B& body, const Visit& visit) {
  visit(body.mesh.vertices_m);
  visit(body.mesh.normals);
  visit(body.mesh.uvs);
  visit(body.mesh.triangles);
  visit(body.mesh.normal_corners);
  visit(body.mesh.uv_corners);
  visit(body.mesh.slots);
  visit(body.mesh.patches);
  visit(body.mesh.order);
  visit(body.mesh.chunks);
}

constexpr std::byte kZeros[8] = {};

std::size_t padded(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

void store(double* to, math::Point3 p) { to[0] = p.x, to[1] = p.y, to[2] = p.z; }
math::Point3 point(const double* from) { return {from[0], from[1], from[2]}; }

bool all_below(std::span<const std::uint32_t> values, std::uint32_t limit) {
  return all_pieces(values.size(), [&](std::size_t begin, std::size_t end) {
    std::uint32_t largest = 0;
    for (const std::uint32_t v : values.subspan(begin, end - begin)) largest = std::max(largest, v);
    return begin == end || largest < limit;
  });
}

/// Whether chunks lie one behind the other in an order of triangles, all of it.
bool chunks_make_sense(const MeshLists& mesh) {
  if (mesh.chunks.empty()) return mesh.order.empty();
  std::size_t end = 0;
  for (const MeshChunk& chunk : mesh.chunks) {
    if (chunk.first != end || chunk.count == 0) return false;
    end += chunk.count;
  }
  return end == mesh.order.size() && end == mesh.triangles.size() &&
         all_below(mesh.order, static_cast<std::uint32_t>(mesh.triangles.size()));
}

}  // namespace

BodyRecord record_of(const Body& body) {
  BodyRecord record;
  Head head{};
  std::size_t k = 0;
  each_list(body, [&](const auto& list) {
    head.counts[k++] = list.size();
    const auto bytes = std::as_bytes(list);
    record.lists.push_back(bytes);
    record.lists.push_back(std::span(kZeros).first(padded(bytes.size()) - bytes.size()));
  });
  std::string names;
  for (const std::string& name : body.mesh.slot_names) names.append(name).push_back('\0');
  head.names = body.mesh.slot_names.size(), head.name_bytes = names.size();
  head.surface_triangles = body.surface_triangles;
  head.patch_count = body.patch_count, head.slot_count = body.slot_count;
  store(head.low_m, body.bounds.low_m), store(head.high_m, body.bounds.high_m);
  store(head.centre_m, body.centre_m), store(head.pilot_point_m, body.pilot_point_m);
  for (std::size_t side = 0; side < 3; ++side)
    store(head.half_sides_m[side], math::Point3{} + body.half_sides_m[side]);
  head.radius_m = body.radius_m, head.pilot_weight = body.pilot_weight,
  head.pilot_is_solid = body.pilot_is_solid;
  record.head.assign(reinterpret_cast<const char*>(&head), sizeof head);
  record.head += names;
  record.head.resize(padded(record.head.size()), '\0');
  return record;
}

std::optional<Body> body_from_record(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper) {
  Head head;
  if (bytes.size() < sizeof head || reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0)
    return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof head);
  bytes = bytes.subspan(sizeof head);
  if (head.names > kMostNames || head.name_bytes > bytes.size() || padded(head.name_bytes) > bytes.size())
    return std::nullopt;
  Body body;
  std::string_view names(reinterpret_cast<const char*>(bytes.data()), head.name_bytes);
  for (std::uint64_t n = 0; n < head.names; ++n) {
    const std::size_t end = names.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    body.mesh.slot_names.emplace_back(names.substr(0, end));
    names.remove_prefix(end + 1);
  }
  if (!names.empty()) return std::nullopt;
  bytes = bytes.subspan(padded(head.name_bytes));

  bool whole = true;
  std::size_t k = 0;
  each_list(body, [&](auto& list) {
    using T = typename std::decay_t<decltype(list)>::element_type;
    const std::uint64_t count = head.counts[k++];
    if (!whole || count > bytes.size() / sizeof(T) || padded(count * sizeof(T)) > bytes.size()) {
      whole = false;
      return;
    }
    list = {reinterpret_cast<T*>(bytes.data()), static_cast<std::size_t>(count)};
    bytes = bytes.subspan(padded(count * sizeof(T)));
  });
  if (!whole || !bytes.empty()) return std::nullopt;
  body.surface_triangles = head.surface_triangles;
  body.patch_count = head.patch_count, body.slot_count = head.slot_count;
  body.bounds = {point(head.low_m), point(head.high_m)};
  for (std::size_t side = 0; side < 3; ++side)
    body.half_sides_m[side] = point(head.half_sides_m[side]) - math::Point3{};
  body.centre_m = point(head.centre_m), body.pilot_point_m = point(head.pilot_point_m);
  body.radius_m = head.radius_m, body.pilot_weight = head.pilot_weight,
  body.pilot_is_solid = head.pilot_is_solid != 0;

  try {
    check_mesh(body.mesh);
  } catch (const InputError&) {
    return std::nullopt;
  }
  if (body.mesh.patches.size() != body.mesh.triangles.size() ||
      !all_below(body.mesh.patches, body.patch_count) || !all_below(body.mesh.slots, body.slot_count) ||
      body.slot_count == 0 || body.mesh.slot_names.size() > body.slot_count || !chunks_make_sense(body.mesh))
    return std::nullopt;
  body.mesh.keeper = std::move(keeper);
  return body;
}

}  // namespace ifov::geometry
