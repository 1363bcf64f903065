#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/shape_tables.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostCopies = 1000000;
constexpr std::size_t kMostVertices = 100000;
constexpr std::size_t kMostTypes = 100;
constexpr double kFlatness = 1e-6;

Kind<double> positive_length() { return quantity(kLength, Range::above(0.0, "m")); }

template <class T>
Kind<T> ball_kind(const std::string& name, const std::string& doc) {
  Record<T> record(name, doc);
  record.required("center", &T::centre_m, point(), "its centre")
      .required("radius", &T::radius_m, positive_length(), "its radius");
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
  const DocumentNode& list = node.given("vertices");
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

}  // namespace

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
          node.given("high").fail(
              format("{} is not above 'low' in every coordinate", node.given("high").title()));
        }
      });
  return record.kind();
}

Kind<SphereShape> sphere_kind() { return ball_kind<SphereShape>("sphere", "A sphere."); }

Kind<HemisphereShape> hemisphere_kind() {
  return ball_kind<HemisphereShape>("hemisphere", "The upper half of a sphere, without a floor.");
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
          node.given("axis").fail(format("{} has no length", node.given("axis").title()));
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

/// "Wavefront OBJ (.obj), PLY (.ply) or glTF 2 (.gltf, .glb)"
std::string mesh_format_list() {
  std::string text;
  const auto formats = mesh_formats();
  for (std::size_t k = 0; k < formats.size(); ++k) {
    if (k > 0) text += k + 1 < formats.size() ? ", " : " or ";
    text += formats[k]->name;
    for (std::size_t e = 0; e < formats[k]->extensions.size(); ++e)
      text += format("{}{}", e > 0 ? ", " : " (", formats[k]->extensions[e]);
    text += ")";
  }
  return text;
}

Kind<MeshShape> mesh_kind() {
  std::vector<std::pair<std::string, double>> units;
  for (const Unit& unit : kLength.units) units.emplace_back(unit.spelling, unit.factor);
  Record<MeshShape> record("mesh", "A triangle mesh from a file.");
  record.required("file", &MeshShape::file, file(), mesh_format_list() + ", told apart by the extension")
      .with_default("unit", &MeshShape::unit_m, choice<double>(units), "\"m\"", "unit of its coordinates")
      .optional(
          "up", &MeshShape::y_is_up, choice<bool>({{"z", false}, {"y", true}}),
          "which of its axes points up, if not y for glTF and z for the others; with y, its z points south");
  return record.kind();
}

Kind<CityShape> city_kind() {
  Record<CityShape> record("city",
                           "The objects of a city model, each of them placed and counted on its own.");
  record
      .required("file", &CityShape::file, file(),
                "a CityJSON file; its coordinates are those of the document")
      .optional(
          "lod", &CityShape::lod,
          text_like("^[0-9]([.][0-9])?$", "a level of detail such as \"2\" or \"2.2\"", "level of detail"),
          "the level of detail to place; the finest of each object if not given")
      .optional("types", &CityShape::types, list(label(), 1, kMostTypes),
                "types of the objects to place, such as \"Building\"; all if not given")
      .check([](const CityShape& city, const DocumentNode& node) {
        const std::string& lod = city.lod;
        const auto digit = [&](std::size_t k) { return lod[k] >= '0' && lod[k] <= '9'; };
        const bool good = lod.empty() || (lod.size() == 1 && digit(0)) ||
                          (lod.size() == 3 && digit(0) && lod[1] == '.' && digit(2));
        if (!good) node.given("lod").fail_expected("a level of detail such as \"2\" or \"2.2\"");
      });
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
      .one("at", &InstancesShape::at_m, list(point(), 1, kMostCopies), "where the prototype's origin goes")
      .one(
          "csv", &InstancesShape::csv, file(),
          "rows of x, y, z in metres, rotation about z in degrees (counter-clockwise from above), scale, pitch "
          "and roll in degrees; the last two or four may be left out")
      .one("binary", &InstancesShape::binary, file(), "a binary instance list (`.ifovinst`)");
  return record.kind();
}

}  // namespace ifov::io
