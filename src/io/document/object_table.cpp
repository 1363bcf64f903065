#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/format.h"
#include "io/document/raster_keys.h"
#include "io/document/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostObjects = 1000000;
constexpr std::size_t kMostVertices = 100000;
constexpr std::size_t kMostClasses = 65536;
constexpr double kFlatness = 1e-6;

Kind<double> positive_length() { return quantity(kLength, Range::above(0.0, "m")); }

Kind<PlaneShape> plane_kind() {
  Record<PlaneShape> record("plane", "A horizontal plane without end, facing up.");
  record.with_default("height", &PlaneShape::height_m, quantity(kLength), "\"0 m\"", "its z");
  return record.kind();
}

Kind<BoxShape> box_kind() {
  Record<BoxShape> record("box", "A box along the axes.");
  record.required("low", &BoxShape::low_m, point(), "corner with the lowest coordinates")
      .required("high", &BoxShape::high_m, point(), "the opposite corner")
      .check([](const BoxShape& box, const DocumentNode& node) {
        const math::Vec3 size = box.high_m - box.low_m;
        if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0)) {
          node.find("high")->fail(
              format("{} is not above 'low' in every coordinate", node.find("high")->title()));
        }
      });
  return record.kind();
}

template <class T>
Kind<T> ball_kind(const std::string& name, const std::string& doc) {
  Record<T> record(name, doc);
  record.required("center", &T::centre_m, point(), "its centre")
      .required("radius", &T::radius_m, positive_length(), "its radius");
  return record.kind();
}

Kind<CylinderShape> cylinder_kind() {
  Record<CylinderShape> record("cylinder", "A circular cylinder.");
  record.required("base", &CylinderShape::base_m, point(), "centre of its base")
      .required("radius", &CylinderShape::radius_m, positive_length(), "its radius")
      .exactly_one()
      .one("axis", &CylinderShape::axis_m, displacement(), "from the centre of the base to that of the top")
      .one(
          "height",
          [](CylinderShape& c, double h) {
            c.axis_m = {0.0, 0.0, h};
          },
          positive_length(), "of an upright cylinder")
      .with_default("capped", &CylinderShape::capped, boolean(), "true", "with a disk at each end")
      .check([](const CylinderShape& cylinder, const DocumentNode& node) {
        if (!(math::length(cylinder.axis_m) > 0.0)) {
          node.find("axis")->fail(format("{} has no length", node.find("axis")->title()));
        }
      });
  return record.kind();
}

Kind<DiskShape> disk_kind() {
  Record<DiskShape> record("disk", "A flat disk.");
  record.required("center", &DiskShape::centre_m, point(), "its centre")
      .required("normal", &DiskShape::normal, direction(), "direction that its front faces, any length")
      .required("radius", &DiskShape::radius_m, positive_length(), "its radius");
  return record.kind();
}

// Newell's normal: twice the area vector, robust for concave outlines.
math::Vec3 area_vector(const std::vector<math::Point3>& vertices) {
  math::Vec3 sum;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const math::Vec3 a = vertices[i] - vertices[0];
    const math::Vec3 b = vertices[(i + 1) % vertices.size()] - vertices[0];
    sum = sum + math::cross(a, b);
  }
  return sum;
}

void check_polygon(const PolygonShape& polygon, const DocumentNode& node) {
  const DocumentNode& list = *node.find("vertices");
  const math::Vec3 area = area_vector(polygon.vertices_m);
  double size = 0.0;
  for (const math::Point3& vertex : polygon.vertices_m) {
    size = std::max(size, math::length(vertex - polygon.vertices_m[0]));
  }
  if (!(math::length(area) > kFlatness * size * size)) list.fail(format("{} enclose no area", list.title()));
  const math::Vec3 normal = math::normalized(area);
  for (std::size_t i = 0; i < polygon.vertices_m.size(); ++i) {
    const double off = std::abs(math::dot(normal, polygon.vertices_m[i] - polygon.vertices_m[0]));
    if (off > kFlatness * size) {
      list.items()[i].fail(
          format("{} lies {:.3g} m outside the plane of the polygon", list.items()[i].title(), off));
    }
  }
}

Kind<PolygonShape> polygon_kind() {
  Record<PolygonShape> record(
      "polygon",
      "A flat polygon, which may be concave; its front is where the vertices run counter-clockwise.");
  record
      .required("vertices", &PolygonShape::vertices_m, list(point(), 3, kMostVertices),
                "its corners in order")
      .check(check_polygon);
  return record.kind();
}

Kind<MeshShape> mesh_kind() {
  std::vector<std::pair<std::string, double>> units;
  for (const Unit& unit : kLength.units) units.emplace_back(unit.spelling, unit.factor);
  Record<MeshShape> record("mesh", "A triangle mesh from a file.");
  record.required("file", &MeshShape::file, file(), "a Wavefront OBJ file")
      .with_default("unit", &MeshShape::unit_m, choice<double>(units), "\"m\"", "unit of its coordinates")
      .with_default("up", &MeshShape::y_is_up, choice<bool>({{"z", false}, {"y", true}}), "\"z\"",
                    "which of its axes points up; with y, its z points south");
  return record.kind();
}

Kind<InstanceShape> instance_kind() {
  Record<InstanceShape> record("instance", "One copy of a prototype.");
  record.required("of", &InstanceShape::of, name_of("a prototype"), "what is copied");
  return record.kind();
}

Kind<InstancesShape> instances_kind() {
  Record<InstancesShape> record("instances", "Many copies of a prototype.");
  record.required("of", &InstancesShape::of, name_of("a prototype"), "what is copied")
      .exactly_one()
      .one("at", &InstancesShape::at_m, list(point(), 1, kMostObjects), "where the prototype's origin goes")
      .one("csv", &InstancesShape::csv, file(),
           "rows of x, y, z in metres, rotation about z in degrees (counter-clockwise from above), scale; "
           "the last "
           "two may be left out");
  return record.kind();
}

Kind<std::vector<std::pair<std::int64_t, DocumentName>>> classes_kind() {
  const auto named = map_of(name_of("a material"), "materials by class number", kMostClasses);
  auto description = *named.description;
  description.pattern = "^(0|-?[1-9][0-9]{0,17})$";
  description.short_name = "materials by class number";
  return {std::make_shared<const ValueDescription>(description),
          [read = named.read](const DocumentNode& node) {
            std::vector<std::pair<std::int64_t, DocumentName>> classes;
            for (auto& [key, name] : read(node)) {
              std::int64_t number = 0;
              const auto parsed = std::from_chars(key.data(), key.data() + key.size(), number);
              if (parsed.ec != std::errc() || parsed.ptr != key.data() + key.size() ||
                  format("{}", number) != key || key.size() > 19) {
                node.find(key)->fail_at_key(format("the key '{}' is not a class number of a raster", key));
              }
              classes.emplace_back(number, std::move(name));
            }
            std::sort(classes.begin(), classes.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
            return classes;
          }};
}

Kind<MaterialBinding> material_kind() {
  const Kind<DocumentName> name = name_of("a material");
  const Kind<MaterialBinding> direct{name.description, [read = name.read](const DocumentNode& node) {
                                       return MaterialBinding{read(node), node.position()};
                                     }};
  Record<MaterialMap> map("material map", "Materials by the class numbers of a raster draped from above.");
  add_raster_keys(map);
  map.required("classes", &MaterialMap::classes, classes_kind(), "material of each class number");
  const auto slots = converted<MaterialSlots>(
      map_of(name, "materials by the names in the mesh file", kMostClasses),
      [](std::vector<std::pair<std::string, DocumentName>> s) { return MaterialSlots{std::move(s)}; });
  Record<MaterialBinding> several("materials of an object", "More than one material on an object.");
  several.exactly_one()
      .one("map", &MaterialBinding::value, map.kind(), "by place")
      .one("slots", &MaterialBinding::value, slots, "by the names that a mesh file uses (usemtl)");
  return either(direct, several.kind());
}

Kind<TransformDocument> transform_kind() {
  struct Rotation {
    math::Vec3 axis;
    double angle_rad = 0.0;
  };
  Record<Rotation> rotation("rotation", "Right-handed, about an axis through the object's origin.");
  rotation.with_default("axis", &Rotation::axis, direction(), "[0, 0, 1]", "its axis, any length")
      .required("angle", &Rotation::angle_rad, quantity(kAngle), "its angle");
  const Kind<double> factor = number(Range::above(0.0));
  const auto uniform = converted<math::Vec3>(factor, [](double s) { return math::Vec3{s, s, s}; });
  const auto by_axis = converted<math::Vec3>(tuple<double, 3>(factor), [](const std::array<double, 3>& s) {
    return math::Vec3{s[0], s[1], s[2]};
  });
  Record<TransformDocument> record("transform", "First scale, then rotate, then translate.");
  record
      .optional("translate", &TransformDocument::translate_m, displacement(),
                "shift to the east, north and up")
      .optional(
          "rotate",
          [](TransformDocument& t, Rotation r) {
            t.rotation_axis = r.axis;
            t.rotation_rad = r.angle_rad;
          },
          rotation.kind(), "rotation")
      .with_default("scale", &TransformDocument::scale, either(uniform, by_axis), "1",
                    "factor on all coordinates, or on each");
  return record.kind();
}

void add_common_keys(Record<ObjectDocument>& record) {
  record.optional("name", &ObjectDocument::name, label(), "for messages and reports")
      .optional("temperature", &ObjectDocument::temperature, temperature_kind(), "instead of the material's")
      .optional("transform", &ObjectDocument::transform, transform_kind(), "where the shape goes")
      .optional("seed", &ObjectDocument::seed, boolean(),
                "send a ray at it where it is smaller than a pixel; decided by its shape if not given");
}

template <class Shape>
void add_shape(Record<ObjectDocument>& record, const std::string& key, const Kind<Shape>& kind) {
  const Kind<std::pair<ShapeDocument, SourcePosition>> located{
      kind.description, [read = kind.read](const DocumentNode& node) {
        return std::pair<ShapeDocument, SourcePosition>(read(node), node.key_position());
      }};
  record.one(
      key,
      [](ObjectDocument& object, std::pair<ShapeDocument, SourcePosition> shape) {
        object.shape = std::move(shape.first);
        object.shape_position = std::move(shape.second);
      },
      located, kind.description->doc);
}

Kind<ObjectDocument> shape_object_kind() {
  Record<ObjectDocument> record("object", "A shape with a material.");
  record.exactly_one();
  add_shape(record, "plane", plane_kind());
  add_shape(record, "box", box_kind());
  add_shape(record, "sphere", ball_kind<SphereShape>("sphere", "A sphere."));
  add_shape(record, "hemisphere",
            ball_kind<HemisphereShape>("hemisphere", "The upper half of a sphere, without a floor."));
  add_shape(record, "cylinder", cylinder_kind());
  add_shape(record, "disk", disk_kind());
  add_shape(record, "polygon", polygon_kind());
  add_shape(record, "mesh", mesh_kind());
  record.required("material", &ObjectDocument::material, material_kind(), "what it is made of");
  add_common_keys(record);
  return record.kind();
}

Kind<ObjectDocument> instance_object_kind() {
  Record<ObjectDocument> record("copies", "Copies of a prototype, whose objects bring their materials.");
  record.exactly_one();
  add_shape(record, "instance", instance_kind());
  add_shape(record, "instances", instances_kind());
  add_common_keys(record);
  return record.kind();
}

}  // namespace

Kind<std::vector<ObjectDocument>> objects_kind(bool with_instances) {
  const Kind<ObjectDocument> shape = shape_object_kind();
  if (!with_instances) return list(shape, 1, kMostObjects);
  const int without_tag = 1;
  const auto any =
      tagged<ObjectDocument>({{{"instance", "instances"}, instance_object_kind()}, {{}, shape}}, without_tag);
  return list(any, 1, kMostObjects);
}

}  // namespace ifov::io
