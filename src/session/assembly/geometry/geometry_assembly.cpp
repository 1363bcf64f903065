#include "session/assembly/geometry/geometry_assembly.h"

#include <algorithm>
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/call_scope.h"
#include "geodesy/utc_time.h"
#include "geometry/presence.h"
#include "geometry/world.h"
#include "geometry/world/world_builder.h"
#include "io/instances/instance_csv.h"
#include "io/instances/instance_file.h"
#include "io/scene_cache/scene_cache.h"
#include "session/assembly/geometry/city_assembly.h"
#include "session/assembly/geometry/mesh_cache.h"
#include "session/assembly/geometry/motion_assembly.h"
#include "session/assembly/geometry/presence_assembly.h"
#include "session/assembly/geometry/random_placement_assembly.h"
#include "session/assembly/geometry/shape_assembly.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"
#include "session/assembly/surfaces/lamp_assembly.h"

namespace ifov::session {
namespace {

/// A prototype with, for each of its slots, what covers it.
struct BuiltPrototype {
  struct Slot {
    const io::ObjectDocument* object;
    std::string name;
    const std::optional<io::TemperatureDocument>* temperature;  ///< the outermost that is given
    std::string file{};                                         ///< of a mesh with the materials of its file
    std::size_t without_uv = 0;
    friend auto operator<=>(const Slot&, const Slot&) = default;
  };
  geometry::ShapeId id;
  std::vector<Slot> slots;
};

/// The slots of a prototype while its parts are put together. Parts that are covered by the same share one: copies of
/// copies of copies would have more slots than there is memory.
class SlotList {
 public:
  std::uint32_t number(const BuiltPrototype::Slot& slot) {
    const auto [known, is_new] = numbers_.emplace(slot, static_cast<std::uint32_t>(slots_.size()));
    if (is_new) slots_.push_back(slot);
    return known->second;
  }
  std::vector<BuiltPrototype::Slot> take() && { return std::move(slots_); }

 private:
  std::map<BuiltPrototype::Slot, std::uint32_t> numbers_;
  std::vector<BuiltPrototype::Slot> slots_;
};

class GeometryAssembly {
 public:
  GeometryAssembly(const GeometrySubject& of, AssignmentAssembly& assignments, const MapFrame& frame,
                   LogSink* log, io::SceneCache* cache)
      : of_(of),
        sources_(of.sources),
        objects_(of.objects),
        prototype_documents_(of.prototypes),
        assignments_(assignments),
        frame_(frame),
        time_(of.time),
        log_(log),
        cache_(cache),
        shapes_(of.sources, frame, builder_, cache, log, assignments.any_medium()) {}

  std::unique_ptr<geometry::World> assemble(std::span<const PlacedLamp> lamps, PlacedObjects& placed,
                                            ProgressSink* progress) {
    for (const io::ObjectDocument& object : objects_) {
      stop_if_cancelled();
      tell(progress, static_cast<std::size_t>(&object - objects_.data()));
      placed.begin(builder_.object_count() + moving_.count());
      object.motion ? place_moving(object) : place_in_its_time(object, true);
    }
    placed.end(builder_.object_count() + moving_.count());
    place_lamps(lamps);
    tell(progress, objects_.size());
    geometry::BuildOptions options;
    options.surveyed = assignments_.mirrors();
    options.lobes = assignments_.lobes();
    options.cut_outs = assignments_.cut_outs();
    return moving_.about(builder_.build(options), of_);
  }

  /// What is there at other times alone; null: nothing is.
  std::unique_ptr<geometry::World> assemble_departed() {
    for (const io::ObjectDocument& object : objects_)
      if (!object.motion) place_in_its_time(object, false);
    if (builder_.object_count() == 0) return nullptr;
    geometry::BuildOptions options;
    options.cut_outs = assignments_.cut_outs();
    return builder_.build(options);
  }

 private:
  /// Which object is next; their number: all are placed.
  void tell(ProgressSink* progress, std::size_t next) const {
    if (progress == nullptr) return;
    progress->phase(next < objects_.size() ? title_of(objects_, next) : "the trees that rays go through");
    Progress now;
    now.pixels_done = static_cast<std::int64_t>(next),
    now.pixels_total = static_cast<std::int64_t>(objects_.size());
    progress->report(now);
  }

  /// Where that is the document's time, or (`now` false) where it is not.
  void place_in_its_time(const io::ObjectDocument& object, bool now) {
    const auto presence = time_ ? assemble_presence(object, *time_) : nullptr;
    if ((!presence || presence->at(0.0)) != now) return;
    builder_.set_presence(presence);
    const math::Transform scene_from_document = math::Transform::translation(-frame_.document_offset_m());
    with_position(sources_, object.position, [&] { place(object, scene_from_document); });
    builder_.set_presence(nullptr);
  }

  /// A world of its own, about what carries it.
  void place_moving(const io::ObjectDocument& object) {
    auto motion = assemble_motion(of_, object, frame_.document_offset_m());
    GeometryAssembly alone(of_, assignments_, frame_, log_, cache_);
    with_position(sources_, object.position, [&] {
      alone.place(object, math::Transform());
      if (alone.builder_.object_count() == 0) return;
      auto body = alone.builder_.build();
      std::vector<bool> covers;
      for (const double area : body->surface_areas_m2(assignments_.count())) covers.push_back(area > 0.0);
      assignments_.refuse_moving(covers);
      moving_.add(std::move(body), std::move(motion), builder_.object_count());
    });
  }

  void place(const io::ObjectDocument& object, const math::Transform& scene_from_document) {
    const math::Transform scene_from_object = scene_from_document * transform_of(object.transform);
    if (const io::DocumentName* of = copied_by(object)) {
      place_copies(object, prototype(of->name), scene_from_object);
    } else if (std::holds_alternative<io::CityShape>(object.shape)) {
      assignments_.refuse_media(*object.material);
      assignments_.refuse_holes(*object.material, true);
      place_city(sources_, object, scene_from_object, frame_, assignments_, builder_, log_);
    } else if (const auto* placement = std::get_if<io::RandomPlacement>(&object.shape)) {
      place_at_random(object, *placement, scene_from_document);
    } else {
      const BuiltShape shape = shapes_.build(object, ShapeAssembly::Use::object);
      if (!shape.has_inside) assignments_.refuse_media(*object.material);
      if (!shape.of_triangles || !shape.may_have_coordinates)
        assignments_.refuse_holes(*object.material, shape.of_triangles);
      std::vector<std::uint32_t> materials;
      for (std::size_t k = 0; k < shape.slot_names.size(); ++k)
        materials.push_back(assignments_.assignment(*object.material, shape.slot_names[k], object.temperature,
                                                    mesh_slot(shape, k)));
      builder_.place(shape.id, scene_from_object * shape.object_from_shape, materials,
                     object.pilot_ray.value_or(true));
    }
  }

  void place_lamps(std::span<const PlacedLamp> lamps) {
    std::optional<geometry::ShapeId> ball, disk;
    for (const PlacedLamp& lamp : lamps) {
      std::optional<geometry::ShapeId>& shape = lamp.is_disk ? disk : ball;
      if (!shape)
        shape = builder_.add_shape(lamp.is_disk ? geometry::Shape(geometry::Disk{})
                                                : geometry::Shape(geometry::Sphere{}));
      const std::vector<std::uint32_t> materials{assignments_.assignment(lamp.state)};
      builder_.place(*shape, lamp.scene_from_unit, materials, true);
    }
  }

  void place_copies(const io::ObjectDocument& object, const BuiltPrototype& built,
                    const math::Transform& scene_from_object) {
    const std::vector<std::uint32_t> materials = materials_of(object, built);
    const bool pilot_ray = object.pilot_ray.value_or(true);
    if (const auto list = list_of(object))
      builder_.place_many(built.id, scene_from_object, list, materials, pilot_ray);
    else
      builder_.place(built.id, scene_from_object, materials, pilot_ray);
  }

  std::vector<std::uint32_t> materials_of(const io::ObjectDocument& object, const BuiltPrototype& built) {
    std::vector<std::uint32_t> materials;
    for (const BuiltPrototype::Slot& slot : built.slots)
      materials.push_back(assignments_.assignment(*slot.object->material, slot.name,
                                                  object.temperature ? object.temperature : *slot.temperature,
                                                  {slot.file, slot.name, slot.without_uv}));
    return materials;
  }

  void place_at_random(const io::ObjectDocument& object, const io::RandomPlacement& placement,
                       const math::Transform& scene_from_document) {
    const geometry::World* carrier =
        placement.on ? &ground(placement.on->name, scene_from_document) : nullptr;
    std::vector<std::vector<io::Instance>> copies = random_copies(sources_, placement, frame_, carrier, log_);
    for (std::size_t k = 0; k < copies.size(); ++k) {
      if (copies[k].empty()) continue;
      const BuiltPrototype& built = prototype(placement.of[k].prototype.name);
      builder_.place_many(built.id, scene_from_document,
                          std::make_shared<io::InstanceList>(std::move(copies[k])),
                          materials_of(object, built), object.pilot_ray.value_or(true));
    }
  }

  bool is_there_now(const io::ObjectDocument& object) const {
    const auto presence = time_ ? assemble_presence(object, *time_) : nullptr;
    return !presence || presence->at(0.0);
  }

  /// The objects of a name on their own, for what stands on them: those that are there now, or all where none is.
  const geometry::World& ground(const std::string& name, const math::Transform& scene_from_document) {
    std::unique_ptr<geometry::World>& world = grounds_[name];
    if (world) return *world;
    GeometryAssembly alone(of_, assignments_, frame_, nullptr, cache_);
    const auto wanted = [&](const io::ObjectDocument& object) {
      return object.name == name && static_cast<bool>(object.material);
    };
    const bool some_now =
        std::any_of(objects_.begin(), objects_.end(),
                    [&](const io::ObjectDocument& object) { return wanted(object) && is_there_now(object); });
    for (const io::ObjectDocument& object : objects_)
      if (wanted(object) && object.motion)
        refuse_motion(of_, object, "copies are placed at random on it, and they would not move along");
      else if (wanted(object) && (!some_now || is_there_now(object)))
        with_position(sources_, object.position, [&] { alone.place(object, scene_from_document); });
    world = alone.builder_.build();
    return *world;
  }

  const BuiltPrototype& prototype(const std::string& name) {
    const auto known = prototypes_.find(name);
    if (known != prototypes_.end()) return known->second;
    BuiltPrototype built;
    SlotList slots;
    std::vector<geometry::Part> parts;
    for (const io::PrototypeDocument& source : prototype_documents_) {
      if (source.name != name) continue;
      for (const io::ObjectDocument& object : source.objects)
        with_position(sources_, object.position, [&] { parts.push_back(part_of(object, slots)); });
    }
    built.slots = std::move(slots).take();
    built.id = builder_.add_prototype(parts);
    return prototypes_.emplace(name, std::move(built)).first->second;
  }

  /// An object of a prototype; its slots are added to those of the prototype.
  geometry::Part part_of(const io::ObjectDocument& object, SlotList& slots) {
    geometry::Part part{{}, transform_of(object.transform), {}};
    std::vector<BuiltPrototype::Slot> own;
    if (const io::DocumentName* of = copied_by(object)) {
      const BuiltPrototype& inner = prototype(of->name);
      part.what = inner.id;
      part.list = list_of(object);
      own = inner.slots;
      if (object.temperature)
        for (BuiltPrototype::Slot& slot : own) slot.temperature = &object.temperature;
    } else {
      const BuiltShape shape = shapes_.build(object, ShapeAssembly::Use::part_of_prototype);
      if (!shape.has_inside) assignments_.refuse_media(*object.material);
      if (!shape.of_triangles || !shape.may_have_coordinates)
        assignments_.refuse_holes(*object.material, shape.of_triangles);
      part.what = shape.id;
      part.prototype_from_part = part.prototype_from_part * shape.object_from_shape;
      for (std::size_t k = 0; k < shape.slot_names.size(); ++k) {
        const MeshSlot slot = mesh_slot(shape, k);
        own.push_back({&object, shape.slot_names[k], &object.temperature, slot.file, slot.without_uv});
      }
    }
    for (const BuiltPrototype::Slot& slot : own) part.slots.push_back(slots.number(slot));
    return part;
  }

  static MeshSlot mesh_slot(const BuiltShape& shape, std::size_t k) {
    return {shape.file, shape.slot_names[k], shape.without_uv.empty() ? 0 : shape.without_uv[k]};
  }

  /// The prototype that an object copies, or null.
  static const io::DocumentName* copied_by(const io::ObjectDocument& object) {
    if (const auto* one = std::get_if<io::InstanceShape>(&object.shape)) return &one->of;
    if (const auto* many = std::get_if<io::InstancesShape>(&object.shape)) return &many->of;
    return nullptr;
  }

  /// Where its copies stand; null: there is one.
  std::shared_ptr<const geometry::Placements> list_of(const io::ObjectDocument& object) const {
    const auto* many = std::get_if<io::InstancesShape>(&object.shape);
    if (many == nullptr) return nullptr;
    const auto file = many->binary ? many->binary : many->csv;
    if (file) {
      const auto list =
          with_position(sources_, file->position, [&]() -> std::shared_ptr<const geometry::Placements> {
            if (many->binary) return std::make_shared<io::InstanceFile>(file->path);
            return cached_instances(cache_, {file->path}, [&] { return io::read_instance_csv(file->path); });
          });
      if (list->count() == 0 && log_ != nullptr)
        log_->warn(format("'{}' holds no copies: nothing is placed", file->path));
      return list;
    }
    std::vector<io::Instance> list;
    for (const math::Point3& at : many->at_m) list.push_back({at});
    return std::make_shared<io::InstanceList>(std::move(list));
  }

  static math::Transform transform_of(const io::TransformDocument& source) {
    math::Transform transform = math::Transform::translation(source.translate_m);
    if (source.rotation_rad != 0.0)
      transform = transform * math::Transform::rotation(source.rotation_axis, source.rotation_rad);
    return transform * math::Transform::scaling(source.scale);
  }

  const GeometrySubject& of_;
  const io::DocumentSources& sources_;
  std::span<const io::ObjectDocument> objects_;
  std::span<const io::PrototypeDocument> prototype_documents_;
  AssignmentAssembly& assignments_;
  const MapFrame& frame_;
  const std::optional<geodesy::UtcTime>& time_;
  LogSink* log_;
  io::SceneCache* cache_;
  MovingObjects moving_;
  geometry::WorldBuilder builder_;
  ShapeAssembly shapes_;
  std::map<std::string, BuiltPrototype> prototypes_;
  std::map<std::string, std::unique_ptr<geometry::World>> grounds_;
};

}  // namespace

std::unique_ptr<geometry::World> assemble_geometry(const GeometrySubject& of, AssignmentAssembly& assignments,
                                                   std::span<const PlacedLamp> lamps, const MapFrame& frame,
                                                   LogSink* log, io::SceneCache* cache, PlacedObjects& placed,
                                                   ProgressSink* progress) {
  return GeometryAssembly(of, assignments, frame, log, cache).assemble(lamps, placed, progress);
}

std::unique_ptr<geometry::World> assemble_departed(const GeometrySubject& of, AssignmentAssembly& assignments,
                                                   const MapFrame& frame, LogSink* log,
                                                   io::SceneCache* cache) {
  return GeometryAssembly(of, assignments, frame, log, cache).assemble_departed();
}

}  // namespace ifov::session
