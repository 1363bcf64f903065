#include "geometry/world_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "geometry/embree_world.h"
#include "geometry/world_content.h"

namespace ifov::geometry {

struct WorldBuilder::Content : WorldContent {
  std::map<std::vector<std::uint32_t>, std::uint32_t>
      known_materials;  ///< list of an object -> where it begins

  const Template& at(ShapeId id) const {
    if (id.value >= templates.size()) throw InputError(format("there is no shape number {}", id.value));
    return templates[id.value];
  }
  std::uint32_t materials_begin(std::span<const std::uint32_t> list) {
    const auto [entry, is_new] =
        known_materials.try_emplace({list.begin(), list.end()}, static_cast<std::uint32_t>(materials.size()));
    if (is_new) materials.insert(materials.end(), list.begin(), list.end());
    return entry->second;
  }
};

namespace {

void require_invertible(const math::Transform& map) {
  const math::Vec3 x = map.column_x(), y = map.column_y(), z = map.column_z();
  const math::Point3 o = map.origin_m();
  const double size = length(x) * length(y) * length(z);
  const bool finite = std::isfinite(o.x) && std::isfinite(o.y) && std::isfinite(o.z) && std::isfinite(size);
  if (!finite || !(std::abs(map.determinant()) > 1e-12 * size))
    throw InputError("the transform of an object has no inverse");
}

}  // namespace

WorldBuilder::WorldBuilder() : content_(std::make_unique<Content>()) {}
WorldBuilder::~WorldBuilder() = default;

ShapeId WorldBuilder::add_shape(Shape shape) {
  Template t;
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    if (!std::isfinite(plane->z_m)) throw InputError("the height of a plane must be finite");
    t.plane = *plane;
  } else {
    t.body = body_of(std::move(shape));
  }
  content_->templates.push_back(std::move(t));
  return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
}

ShapeId WorldBuilder::add_prototype(std::span<const Part> parts) {
  if (parts.empty()) throw InputError("a prototype has no parts");
  Template whole;
  for (const Part& part : parts) {
    const Template& t = content_->at(part.what);
    if (t.plane) throw InputError("a plane cannot be part of a prototype");
    if (!part.slots.empty() && part.slots.size() != t.body.slot_count)
      throw InputError(
          format("a part has {} material slots, {} are given", t.body.slot_count, part.slots.size()));
    require_invertible(part.prototype_from_part);
    for (const std::uint32_t s : part.slots) whole.body.slot_count = std::max(whole.body.slot_count, s + 1);
    append_part(whole.body, t.body, part.prototype_from_part, part.slots);
  }
  settle_bounds(whole.body);
  content_->templates.push_back(std::move(whole));
  return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
}

std::size_t WorldBuilder::slot_count(ShapeId what) const {
  const Template& t = content_->at(what);
  return t.plane ? 1 : t.body.slot_count;
}

std::uint32_t WorldBuilder::place(ShapeId what, const math::Transform& scene_from_object,
                                  std::span<const std::uint32_t> material_of_slot, bool seed) {
  const std::size_t slots = slot_count(what);
  if (material_of_slot.size() != slots)
    throw InputError(format("an object has {} material slots, {} are given", slots, material_of_slot.size()));
  require_invertible(scene_from_object);
  Template& t = content_->templates[what.value];
  if (t.plane) {
    const math::Vec3 x = scene_from_object.column_x(), y = scene_from_object.column_y(),
                     z = scene_from_object.column_z();
    if (std::abs(x.z) > 1e-12 * length(x) || std::abs(y.z) > 1e-12 * length(y) || !(z.z > 0.0))
      throw InputError("a plane must stay horizontal, its outer side up");
  }
  if (content_->placements.size() >= kNoIndex) throw InputError("there are too many objects");
  ++t.uses;
  content_->placements.push_back(
      {what.value, content_->materials_begin(material_of_slot), seed, scene_from_object});
  return static_cast<std::uint32_t>(content_->placements.size() - 1);
}

std::unique_ptr<World> WorldBuilder::build(int threads) {
  const std::unique_ptr<Content> content = std::exchange(content_, std::make_unique<Content>());
  content->known_materials.clear();
  return std::make_unique<EmbreeWorld>(std::move(static_cast<WorldContent&>(*content)), threads);
}

}  // namespace ifov::geometry
