#include "session/assembly/geometry/shape_assembly.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/error.h"
#include "core/overloaded.h"
#include "geometry/mesh_topology.h"
#include "io/document/shapes/primitive.h"
#include "io/mesh/mesh_reader.h"
#include "session/assembly/geometry/mesh_cache.h"
#include "session/assembly/geometry/terrain_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

/// A thing that stands on y = 0 and reaches below z = 0 was most likely drawn with y up.
void warn_of_y_up(const std::string& path, const geometry::World::Bounds& b, LogSink& log) {
  constexpr double kOnGround = 0.01, kBelow = 0.1;
  const math::Vec3 size = b.high_m - b.low_m;
  if (!(size.y > 0.0) || !(size.z > 0.0) || std::abs(b.low_m.y) > kOnGround * size.y) return;
  constexpr double kFlat = 0.02;  // waves of a water that begins at y = 0
  if (size.z < kFlat * size.y) return;
  if (b.low_m.z > -kBelow * size.z || b.high_m.z < kBelow * size.z ||
      std::abs(b.low_m.x) <= kOnGround * size.x)
    return;
  log.warn(format(
      "mesh '{}' stands on y = 0 and reaches {:.3g} below z = 0: if its y points up, say \"up\": \"y\"",
      std::filesystem::path(path).filename().string(), -b.low_m.z));
}

/// By slot.
std::vector<std::size_t> triangles_without_uv(const geometry::MeshLists& mesh, std::size_t slots) {
  std::vector<std::size_t> counts(slots, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const geometry::Triangle& corners = mesh.uv_corners.empty() ? mesh.triangles[t] : mesh.uv_corners[t];
    const bool has = !mesh.uvs.empty() &&
                     std::ranges::none_of(corners, [](std::uint32_t c) { return c == geometry::kNoIndex; });
    if (!has) ++counts[mesh.slots.empty() ? 0 : mesh.slots[t]];
  }
  return counts;
}

/// Of what is no mesh.
bool has_inside(const geometry::Shape& shape) {
  return std::visit(
      Overloaded{[](const geometry::Plane&) { return true; }, [](const geometry::Box&) { return true; },
                 [](const geometry::Sphere&) { return true; },
                 [](const geometry::Cylinder& s) { return s.capped; },
                 [](const geometry::PlacedUnit& s) { return s.solid; }, [](const auto&) { return false; }},
      shape);
}

}  // namespace

BuiltShape ShapeAssembly::build(const io::ObjectDocument& object, Use use) {
  use_ = use;
  with_materials_ = object.material &&
                    std::holds_alternative<std::shared_ptr<const io::FileMaterials>>(object.material->value);
  return std::visit([&](const auto& s) { return shape(s); }, object.shape);
}

BuiltShape ShapeAssembly::shape(const io::PrimitiveShape& s) {
  io::PrimitiveSettings::Built built = s.settings->build();
  const bool inside = has_inside(built.shape),
             triangles = std::holds_alternative<geometry::Polygon>(built.shape) ||
                         std::holds_alternative<geometry::TriangleMesh>(built.shape);
  return {
      builder_.add_shape(std::move(built.shape)), built.object_from_shape, {""}, inside, triangles, false};
}

BuiltShape ShapeAssembly::shape(const io::MeshShape& s) {
  const bool y_is_up = s.y_is_up.value_or(io::format_has_y_up(s.file.path));
  const std::string key = format("{}|{}|{}|{}", s.file.path, s.unit_m, y_is_up, with_materials_);
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  return with_position(sources_, s.file.position, [&] {
    geometry::Body body = cached_mesh(
        cache_,
        {{s.file.path},
         with_materials_ ? "with materials" : "",
         [&] { return io::further_mesh_files(s.file.path); }},
        [&] {
          return io::read_mesh(s.file.path, log_,
                               with_materials_ ? io::MeshUse::with_materials : io::MeshUse::shape);
        });
    if (!y_is_up && log_ != nullptr) warn_of_y_up(s.file.path, body.bounds, *log_);
    std::vector<std::string> slots = body.mesh.slot_names;
    if (slots.empty()) slots = {""};
    math::Transform object_from_file = math::Transform::scaling({s.unit_m, s.unit_m, s.unit_m});
    if (y_is_up) object_from_file = object_from_file * math::Transform::rotation({1.0, 0.0, 0.0}, 0.5 * M_PI);
    const bool inside =
        tells_insides_ && geometry::topology_of(body.mesh.vertices_m, body.mesh.triangles).closed;
    std::vector<std::size_t> without_uv;
    if (with_materials_) without_uv = triangles_without_uv(body.mesh, slots.size());
    BuiltShape built{builder_.add_body(std::move(body)), object_from_file, std::move(slots), inside};
    if (with_materials_) built.file = s.file.path;
    built.without_uv = std::move(without_uv);
    return meshes_.emplace(key, built).first->second;
  });
}

BuiltShape ShapeAssembly::shape(const io::TerrainShape& s) {
  // Its coordinates are about the scene's origin; the object's transform is meant for those of the document.
  return with_position(sources_, s.file.position, [&]() -> BuiltShape {
    const bool raster = is_traced_in_raster(s, frame_, use_ == Use::part_of_prototype);
    return {raster ? builder_.add_height_field(assemble_height_field(s, frame_, log_))
                   : builder_.add_body(assemble_terrain(s, frame_, cache_, log_)),
            math::Transform::translation(frame_.document_offset_m()),
            {""},
            false,
            !raster,
            false};
  });
}

BuiltShape ShapeAssembly::shape(const io::CityShape&) { throw InputError("a prototype cannot hold a city"); }

BuiltShape ShapeAssembly::shape(const io::InstanceShape&) {
  throw InputError("a copy of a prototype is not a shape");
}

BuiltShape ShapeAssembly::shape(const io::InstancesShape&) {
  throw InputError("copies of a prototype are not a shape");
}

BuiltShape ShapeAssembly::shape(const io::RandomPlacement&) {
  throw InputError("copies of prototypes are not a shape");
}

}  // namespace ifov::session
