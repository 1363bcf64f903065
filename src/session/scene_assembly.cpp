#include "session/scene_assembly.h"

#include <cmath>
#include <map>

#include "geometry/world_builder.h"
#include "io/mesh/obj_reader.h"
#include "io/tables/number_table.h"
#include "session/covering_assembly.h"
#include "session/light_assembly.h"
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
  GeometryAssembly(const io::Document& document, CoveringAssembly& coverings)
      : document_(document), coverings_(coverings) {}

  std::unique_ptr<geometry::World> assemble() {
    const math::Vec3 offset_m = document_.scene.origin.offset_m;
    const math::Transform scene_from_document = math::Transform::translation(-offset_m);
    for (const io::ObjectDocument& object : document_.scene.objects)
      with_position(document_, object.position, [&] { place(object, scene_from_document, offset_m); });
    return builder_.build();
  }

 private:
  void place(const io::ObjectDocument& object, const math::Transform& scene_from_document, math::Vec3 offset_m) {
    const math::Transform scene_from_object = scene_from_document * transform_of(object.transform);
    if (const auto* one = std::get_if<io::InstanceShape>(&object.shape)) {
      place_prototype(object, prototype(one->of.name), scene_from_object);
    } else if (const auto* many = std::get_if<io::InstancesShape>(&object.shape)) {
      const BuiltPrototype& built = prototype(many->of.name);
      for (const math::Transform& object_from_copy : copies(*many))
        place_prototype(object, built, scene_from_object * object_from_copy);
    } else {
      const BuiltShape shape = build_shape(object);
      std::vector<std::uint32_t> materials;
      for (const std::string& slot : shape.slot_names)
        materials.push_back(coverings_.covering(*object.material, slot, object.temperature, offset_m));
      builder_.place(shape.id, scene_from_object * shape.object_from_shape, materials, object.seed.value_or(true));
    }
  }

  void place_prototype(const io::ObjectDocument& object, const BuiltPrototype& built,
                       const math::Transform& scene_from_object) {
    std::vector<std::uint32_t> materials;
    for (const BuiltPrototype::Slot& slot : built.slots)
      materials.push_back(coverings_.covering(*slot.object->material, slot.name,
                                              object.temperature ? object.temperature : slot.object->temperature, {}));
    builder_.place(built.id, scene_from_object, materials, object.seed.value_or(true));
  }

  const BuiltPrototype& prototype(const std::string& name) {
    const auto known = prototypes_.find(name);
    if (known != prototypes_.end()) return known->second;
    BuiltPrototype built;
    std::vector<geometry::Part> parts;
    for (const io::PrototypeDocument& source : document_.scene.prototypes) {
      if (source.name != name) continue;
      for (const io::ObjectDocument& object : source.objects) {
        const BuiltShape shape = build_shape(object);
        geometry::Part part{shape.id, transform_of(object.transform) * shape.object_from_shape, {}};
        for (const std::string& slot : shape.slot_names) {
          part.slots.push_back(static_cast<std::uint32_t>(built.slots.size()));
          built.slots.push_back({&object, slot});
        }
        parts.push_back(std::move(part));
      }
    }
    built.id = builder_.add_prototype(parts);
    return prototypes_.emplace(name, std::move(built)).first->second;
  }

  std::vector<math::Transform> copies(const io::InstancesShape& source) const {
    std::vector<math::Transform> copies;
    for (const math::Point3& at : source.at_m)
      copies.push_back(math::Transform::translation({at.x, at.y, at.z}));
    if (source.csv)
      with_position(document_, source.csv->position, [&] {
        const io::NumberTable table = io::read_number_table(source.csv->path, 5);
        for (std::size_t row = 0; row < table.rows(); ++row) {
          const double* v = table.row(row);
          copies.push_back(math::Transform::translation({v[0], v[1], v[2]}) *
                           math::Transform::rotation({0.0, 0.0, 1.0}, v[3] * M_PI / 180.0) *
                           math::Transform::scaling({v[4], v[4], v[4]}));
        }
      });
    return copies;
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
    const std::string key = format("{}|{}|{}", s.file.path, s.unit_m, s.y_is_up);
    const auto known = meshes_.find(key);
    if (known != meshes_.end()) return known->second;
    return with_position(document_, s.file.position, [&] {
      geometry::TriangleMesh mesh = io::read_obj(s.file.path);
      std::vector<std::string> slots = mesh.slot_names.empty() ? std::vector<std::string>{""} : mesh.slot_names;
      math::Transform object_from_file = math::Transform::scaling({s.unit_m, s.unit_m, s.unit_m});
      if (s.y_is_up)
        object_from_file = object_from_file * math::Transform::rotation({1.0, 0.0, 0.0}, 0.5 * M_PI);
      const BuiltShape built{builder_.add_shape(std::move(mesh)), object_from_file, std::move(slots)};
      return meshes_.emplace(key, built).first->second;
    });
  }
  BuiltShape build(const io::InstanceShape&) { throw InputError("a prototype cannot hold instances"); }
  BuiltShape build(const io::InstancesShape&) { throw InputError("a prototype cannot hold instances"); }

  const io::Document& document_;
  CoveringAssembly& coverings_;
  geometry::WorldBuilder builder_;
  std::map<std::string, BuiltPrototype> prototypes_;
  std::map<std::string, BuiltShape> meshes_;
};

}  // namespace

scene::Scene assemble_scene(const io::Document& document, LogSink* log) {
  scene::Scene scene;
  CoveringAssembly coverings(document, scene);
  scene.world = GeometryAssembly(document, coverings).assemble();
  assemble_light(document, scene);
  if (log != nullptr) log->info(format("scene: {} objects, {} triangles", scene.world->objects().size(),
                                       scene.world->triangle_count()));
  return scene;
}

}  // namespace ifov::session
