#include "geometry/world/world_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "geometry/world/embree_world.h"
#include "geometry/world/world_content.h"

namespace ifov::geometry {

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

struct WorldBuilder::Content : WorldContent {
  /// List of an object -> where it begins.
  std::map<std::vector<std::uint32_t>, std::uint32_t> known_materials;
  std::shared_ptr<const Presence> presence;  ///< of what is placed next

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

  std::uint32_t place(TemplatePart what, std::span<const std::uint32_t> material_of_slot, bool pilot_ray) {
    Template& t = templates[what.of];
    if (material_of_slot.size() != t.slot_count)
      throw InputError(
          format("an object has {} material slots, {} are given", t.slot_count, material_of_slot.size()));
    const std::size_t copies = what.copies();
    if (copies >= kNoIndex - object_count) throw InputError("there are too many objects");
    for (std::size_t k = 0; k < copies; ++k) require_invertible(what.whole_from_copy(k));
    const std::uint32_t first = object_count;
    if (copies == 0 || t.nothing) return first;
    t.uses += copies;
    object_count += static_cast<std::uint32_t>(copies);
    runs.push_back({std::move(what), materials_begin(material_of_slot), first, pilot_ray, presence});
    return first;
  }
};

WorldBuilder::WorldBuilder() : content_(std::make_unique<Content>()) {}
WorldBuilder::~WorldBuilder() = default;

ShapeId WorldBuilder::add_shape(Shape shape) {
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    if (!std::isfinite(plane->z_m)) throw InputError("the height of a plane must be finite");
    Template t;
    t.plane = *plane;
    content_->templates.push_back(std::move(t));
    return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
  }
  return add_body(body_of(std::move(shape)));
}

ShapeId WorldBuilder::add_body(Body body) {
  Template t;
  t.slot_count = body.slot_count;
  t.body = std::move(body);
  content_->templates.push_back(std::move(t));
  return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
}

ShapeId WorldBuilder::add_height_field(std::shared_ptr<const HeightField> field) {
  Template t;
  t.field = std::move(field);
  content_->templates.push_back(std::move(t));
  return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
}

ShapeId WorldBuilder::add_prototype(std::span<const Part> parts) {
  Template whole;
  for (const Part& part : parts) {
    const Template& t = content_->at(part.what);
    if (t.plane) throw InputError("a plane cannot be part of a prototype");
    if (t.field) throw InputError("a terrain that is traced as a grid cannot be part of a prototype");
    if (!part.slots.empty() && part.slots.size() != t.slot_count)
      throw InputError(format("a part has {} material slots, {} are given", t.slot_count, part.slots.size()));
    TemplatePart kept{part.what.value, part.prototype_from_part, part.list, part.slots};
    for (const std::uint32_t s : part.slots) whole.slot_count = std::max(whole.slot_count, s + 1);
    if (kept.copies() == 0 || t.nothing) continue;
    for (std::size_t k = 0; k < kept.copies(); ++k) require_invertible(kept.whole_from_copy(k));
    whole.parts.push_back(std::move(kept));
  }
  if (parts.empty()) throw InputError("a prototype has no parts");
  whole.nothing = whole.parts.empty();
  content_->templates.push_back(std::move(whole));
  return {static_cast<std::uint32_t>(content_->templates.size() - 1)};
}

std::uint32_t WorldBuilder::object_count() const { return content_->object_count; }

void WorldBuilder::set_presence(std::shared_ptr<const Presence> presence) {
  content_->presence = std::move(presence);
}

std::size_t WorldBuilder::slot_count(ShapeId what) const { return content_->at(what).slot_count; }

std::uint32_t WorldBuilder::place(ShapeId what, const math::Transform& scene_from_object,
                                  std::span<const std::uint32_t> material_of_slot, bool pilot_ray) {
  if (content_->at(what).plane) {
    const math::Vec3 x = scene_from_object.column_x(), y = scene_from_object.column_y(),
                     z = scene_from_object.column_z();
    if (std::abs(x.z) > 1e-12 * length(x) || std::abs(y.z) > 1e-12 * length(y) || !(z.z > 0.0))
      throw InputError("a plane must stay horizontal, its outer side up");
  }
  return content_->place({what.value, scene_from_object, nullptr, {}}, material_of_slot, pilot_ray);
}

std::uint32_t WorldBuilder::place_many(ShapeId what, const math::Transform& scene_from_list,
                                       std::shared_ptr<const Placements> list,
                                       std::span<const std::uint32_t> material_of_slot, bool pilot_ray) {
  if (content_->at(what).plane) throw InputError("a plane cannot be placed many times");
  if (content_->at(what).field)
    throw InputError("a terrain that is traced as a grid cannot be placed many times");
  return content_->place({what.value, scene_from_list, std::move(list), {}}, material_of_slot, pilot_ray);
}

std::unique_ptr<World> WorldBuilder::build(const BuildOptions& options) {
  const std::unique_ptr<Content> content = std::exchange(content_, std::make_unique<Content>());
  content->known_materials.clear();
  return std::make_unique<EmbreeWorld>(std::move(static_cast<WorldContent&>(*content)), options);
}

}  // namespace ifov::geometry
