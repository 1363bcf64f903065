#include "session/scene_assembly.h"

#include <cmath>
#include <map>

#include "geometry/periodic_world.h"
#include "geometry/world_builder.h"
#include "io/instances/instance_csv.h"
#include "io/instances/instance_file.h"
#include "io/mesh/mesh_reader.h"
#include "session/city_assembly.h"
#include "session/covering_assembly.h"
#include "session/light_assembly.h"
#include "session/map_frame.h"
#include "session/mesh_cache.h"
#include "session/scatter_assembly.h"
#include "session/terrain_assembly.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

/// A shape that the builder knows, in the frame of the object that asked for it.
struct BuiltShape {
  geometry::ShapeId id;
  math::Transform object_from_shape;
  std::vector<std::string> slot_names;
};

/// A prototype with, for each of its slots, what covers it.
struct BuiltPrototype {
  struct Slot {
    const io::ObjectDocument* object;
    std::string name;
    const std::optional<io::TemperatureDocument>* temperature;  ///< the outermost that is given
  };
  geometry::ShapeId id;
  std::vector<Slot> slots;
};

math::Transform turn_z_to(math::Vec3 axis) {
  const math::Vec3 to = math::normalized(axis);
  const math::Vec3 about = math::cross({0.0, 0.0, 1.0}, to);
  const double sine = math::length(about);
  if (sine < 1e-12) return to.z > 0.0 ? math::Transform() : math::Transform::rotation({1.0, 0.0, 0.0}, M_PI);
  return math::Transform::rotation(about, std::atan2(sine, to.z));
}

class GeometryAssembly {
 public:
  GeometryAssembly(const io::Document& document, CoveringAssembly& coverings, const MapFrame& frame, LogSink* log)
      : document_(document), coverings_(coverings), frame_(frame), log_(log) {}

  std::unique_ptr<geometry::World> assemble() {
    const math::Transform scene_from_document = math::Transform::translation(-document_.scene.origin.offset_m);
    for (const io::ObjectDocument& object : document_.scene.objects)
      with_position(document_, object.position, [&] { place(object, scene_from_document); });
    return builder_.build();
  }

  /// Where meshes and lists are kept from run to run; null: nowhere.
  void use(io::SceneCache* cache) { cache_ = cache; }

 private:
  void place(const io::ObjectDocument& object, const math::Transform& scene_from_document) {
    const math::Transform scene_from_object = scene_from_document * transform_of(object.transform);
    if (const io::DocumentName* of = copied_by(object)) {
      place_copies(object, prototype(of->name), scene_from_object);
    } else if (std::holds_alternative<io::CityShape>(object.shape)) {
      place_city(document_, object, scene_from_object, frame_, coverings_, builder_, log_);
    } else if (const auto* scatter = std::get_if<io::ScatterShape>(&object.shape)) {
      place_scatter(object, *scatter, scene_from_document);
    } else {
      const BuiltShape shape = build_shape(object);
      std::vector<std::uint32_t> materials;
      for (const std::string& slot : shape.slot_names)
        materials.push_back(coverings_.covering(*object.material, slot, object.temperature));
      builder_.place(shape.id, scene_from_object * shape.object_from_shape, materials, object.seed.value_or(true));
    }
  }

  void place_copies(const io::ObjectDocument& object, const BuiltPrototype& built,
                    const math::Transform& scene_from_object) {
    const std::vector<std::uint32_t> materials = materials_of(object, built);
    const bool seed = object.seed.value_or(true);
    if (const auto list = list_of(object))
      builder_.place_many(built.id, scene_from_object, list, materials, seed);
    else
      builder_.place(built.id, scene_from_object, materials, seed);
  }

  std::vector<std::uint32_t> materials_of(const io::ObjectDocument& object, const BuiltPrototype& built) {
    std::vector<std::uint32_t> materials;
    for (const BuiltPrototype::Slot& slot : built.slots)
      materials.push_back(coverings_.covering(*slot.object->material, slot.name,
                                              object.temperature ? object.temperature : *slot.temperature));
    return materials;
  }

  void place_scatter(const io::ObjectDocument& object, const io::ScatterShape& scatter,
                     const math::Transform& scene_from_document) {
    const geometry::World* carrier = scatter.on ? &ground(scatter.on->name, scene_from_document) : nullptr;
    std::vector<std::vector<io::Instance>> copies = scatter_copies(document_, scatter, frame_, carrier, log_);
    for (std::size_t k = 0; k < copies.size(); ++k) {
      if (copies[k].empty()) continue;
      const BuiltPrototype& built = prototype(scatter.of[k].prototype.name);
      builder_.place_many(built.id, scene_from_document, std::make_shared<io::InstanceList>(std::move(copies[k])),
                          materials_of(object, built), object.seed.value_or(true));
    }
  }

  /// The objects of a name on their own, for what stands on them.
  const geometry::World& ground(const std::string& name, const math::Transform& scene_from_document) {
    std::unique_ptr<geometry::World>& world = grounds_[name];
    if (world) return *world;
    GeometryAssembly alone(document_, coverings_, frame_, nullptr);
    alone.use(cache_);
    for (const io::ObjectDocument& object : document_.scene.objects)
      if (object.name == name && object.material)
        with_position(document_, object.position, [&] { alone.place(object, scene_from_document); });
    world = alone.builder_.build();
    return *world;
  }

  const BuiltPrototype& prototype(const std::string& name) {
    const auto known = prototypes_.find(name);
    if (known != prototypes_.end()) return known->second;
    BuiltPrototype built;
    std::vector<geometry::Part> parts;
    for (const io::PrototypeDocument& source : document_.scene.prototypes) {
      if (source.name != name) continue;
      for (const io::ObjectDocument& object : source.objects)
        with_position(document_, object.position, [&] { parts.push_back(part_of(object, built.slots)); });
    }
    built.id = builder_.add_prototype(parts);
    return prototypes_.emplace(name, std::move(built)).first->second;
  }

  /// An object of a prototype; its slots are added to those of the prototype.
  geometry::Part part_of(const io::ObjectDocument& object, std::vector<BuiltPrototype::Slot>& slots) {
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
      const BuiltShape shape = build_shape(object);
      part.what = shape.id;
      part.prototype_from_part = part.prototype_from_part * shape.object_from_shape;
      for (const std::string& slot : shape.slot_names) own.push_back({&object, slot, &object.temperature});
    }
    for (const BuiltPrototype::Slot& slot : own) {
      part.slots.push_back(static_cast<std::uint32_t>(slots.size()));
      slots.push_back(slot);
    }
    return part;
  }

  /// The prototype that an object copies, or null.
  static const io::DocumentName* copied_by(const io::ObjectDocument& object) {
    if (const auto* one = std::get_if<io::InstanceShape>(&object.shape)) return &one->of;
    if (const auto* many = std::get_if<io::InstancesShape>(&object.shape)) return &many->of;
    return nullptr;
  }

  /// Where its copies stand; null: there is one.
  std::shared_ptr<const geometry::Placings> list_of(const io::ObjectDocument& object) const {
    const auto* many = std::get_if<io::InstancesShape>(&object.shape);
    if (many == nullptr) return nullptr;
    if (many->binary)
      return with_position(document_, many->binary->position, [&]() -> std::shared_ptr<const geometry::Placings> {
        return std::make_shared<io::InstanceFile>(many->binary->path);
      });
    if (many->csv)
      return with_position(document_, many->csv->position, [&] {
        return cached_instances(cache_, {many->csv->path},
                                [&] { return io::read_instance_csv(many->csv->path); });
      });
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

  BuiltShape build_shape(const io::ObjectDocument& object) {
    return std::visit([&](const auto& shape) { return build(shape); }, object.shape);
  }

  BuiltShape build(const io::PlaneShape& s) { return {builder_.add_shape(geometry::Plane{s.height_m}), {}, {""}}; }
  BuiltShape build(const io::BoxShape& s) { return {builder_.add_shape(geometry::Box{s.low_m, s.high_m}), {}, {""}}; }
  BuiltShape build(const io::SphereShape& s) {
    return {builder_.add_shape(geometry::Sphere{s.centre_m, s.radius_m}), {}, {""}};
  }
  BuiltShape build(const io::HemisphereShape& s) {
    return {builder_.add_shape(geometry::Hemisphere{s.centre_m, s.radius_m}), {}, {""}};
  }
  BuiltShape build(const io::CylinderShape& s) {
    const geometry::Cylinder upright{{}, s.radius_m, math::length(s.axis_m), s.capped};
    return {builder_.add_shape(upright),
            math::Transform::translation({s.base_m.x, s.base_m.y, s.base_m.z}) * turn_z_to(s.axis_m),
            {""}};
  }
  BuiltShape build(const io::DiskShape& s) {
    return {builder_.add_shape(geometry::Disk{{}, s.radius_m}),
            math::Transform::translation({s.centre_m.x, s.centre_m.y, s.centre_m.z}) * turn_z_to(s.normal),
            {""}};
  }
  BuiltShape build(const io::PolygonShape& s) {
    return {builder_.add_shape(geometry::Polygon{s.vertices_m}), {}, {""}};
  }
  BuiltShape build(const io::MeshShape& s) {
    const bool y_is_up = s.y_is_up.value_or(io::format_has_y_up(s.file.path));
    const std::string key = format("{}|{}|{}", s.file.path, s.unit_m, y_is_up);
    const auto known = meshes_.find(key);
    if (known != meshes_.end()) return known->second;
    return with_position(document_, s.file.position, [&] {
      geometry::Body body = cached_mesh(cache_, s.file.path, [&] { return io::read_mesh(s.file.path, log_); });
      std::vector<std::string> slots = body.mesh.slot_names;
      if (slots.empty()) slots = {""};
      math::Transform object_from_file = math::Transform::scaling({s.unit_m, s.unit_m, s.unit_m});
      if (y_is_up)
        object_from_file = object_from_file * math::Transform::rotation({1.0, 0.0, 0.0}, 0.5 * M_PI);
      const BuiltShape built{builder_.add_body(std::move(body)), object_from_file, std::move(slots)};
      return meshes_.emplace(key, built).first->second;
    });
  }
  BuiltShape build(const io::TerrainShape& s) {
    // Its coordinates are about the scene's origin; the object's transform is meant for those of the document.
    return with_position(document_, s.file.position, [&]() -> BuiltShape {
      return {builder_.add_shape(assemble_terrain(s, frame_, log_)),
              math::Transform::translation(document_.scene.origin.offset_m),
              {""}};
    });
  }
  BuiltShape build(const io::CityShape&) { throw InputError("a prototype cannot hold a city"); }
  BuiltShape build(const io::InstanceShape&) { throw InputError("a copy of a prototype is not a shape"); }
  BuiltShape build(const io::InstancesShape&) { throw InputError("copies of a prototype are not a shape"); }
  BuiltShape build(const io::ScatterShape&) { throw InputError("copies of prototypes are not a shape"); }

  const io::Document& document_;
  CoveringAssembly& coverings_;
  const MapFrame& frame_;
  LogSink* log_;
  io::SceneCache* cache_ = nullptr;
  geometry::WorldBuilder builder_;
  std::map<std::string, BuiltPrototype> prototypes_;
  std::map<std::string, BuiltShape> meshes_;
  std::map<std::string, std::unique_ptr<geometry::World>> grounds_;
};

/// What stands in the scene and how it is kept.
std::string describe(const geometry::World& world) {
  const geometry::World::Storage kept = world.storage();
  std::string text = format("scene: {} objects, {} triangles, {:.1f} MB", world.object_count(), world.triangle_count(),
                            static_cast<double>(kept.bytes) / 1e6);
  if (kept.instances > 0)
    text += format("; {} instances of {} triangles{}", kept.instances, kept.stored_triangles,
                   kept.instance_table ? " in a table" : "");
  if (kept.prototypes_apart > 0)
    text += format("; {} prototypes of prototypes stand part by part", kept.prototypes_apart);
  return text;
}

}  // namespace

scene::Scene assemble_scene(const io::Document& document, LogSink* log, std::vector<MapScale>& map_scales,
                            io::SceneCache* cache) {
  scene::Scene scene;
  const MapFrame frame(document);
  CoveringAssembly coverings(document, frame, scene, log);
  GeometryAssembly geometry(document, coverings, frame, log);
  geometry.use(cache);
  scene.world = geometry.assemble();
  map_scales = coverings.map_scales();
  if (document.scene.periodic) {
    const io::PeriodicDocument& periodic = *document.scene.periodic;
    geometry::PeriodicWorld::Cell cell{-0.5 * periodic.width_m, -0.5 * periodic.height_m, periodic.width_m,
                                       periodic.height_m};
    if (periodic.low_left_m) {
      cell.west_m = (*periodic.low_left_m)[0] - document.scene.origin.offset_m.x;
      cell.south_m = (*periodic.low_left_m)[1] - document.scene.origin.offset_m.y;
    }
    scene.world = with_position(document, periodic.position, [&] {
      return std::make_unique<geometry::PeriodicWorld>(std::move(scene.world), cell);
    });
  }
  assemble_light(document, scene);
  if (log != nullptr) log->info(describe(*scene.world));
  return scene;
}

}  // namespace ifov::session
