#include "io/document/shapes/flat_primitives.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/shapes/measures.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostVertices = 100000;
/// Of a polygon's size: less area than this, squared, is none, and its triangles may lie so far outside a plane, as coordinates
/// that were rounded do.
constexpr double kLeastArea = 1e-6, kFlatness = 1e-3;

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

void check_polygon(const PolygonPrimitive& polygon, const DocumentNode& node) {
  const DocumentNode& list = node.given("vertices");
  const math::Vec3 area = area_vector(polygon.vertices_m);
  double size = 0.0;
  for (const math::Point3& vertex : polygon.vertices_m) {
    size = std::max(size, math::length(vertex - polygon.vertices_m[0]));
  }
  if (!(math::length(area) > kLeastArea * size * size)) list.fail(format("{} enclose no area", list.title()));
  const math::Vec3 normal = math::normalized(area);
  for (std::size_t i = 0; i < polygon.vertices_m.size(); ++i) {
    const double off = std::abs(math::dot(normal, polygon.vertices_m[i] - polygon.vertices_m[0]));
    if (off > kFlatness * size) {
      list.items()[i].fail(format(
          "{} lies {:.3g} m outside the plane of the polygon; at most {:.3g} m, a thousandth of its size, may be rounding",
          list.items()[i].title(), off, kFlatness * size));
    }
  }
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> plane_type() {
  Record<PlanePrimitive> record("plane", "A horizontal plane without end, facing up.");
  record.with_default("height", &PlanePrimitive::height_m, quantity(kLength), "\"0 m\"", "its z");
  return primitive_type(record.type());
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> disk_type() {
  Record<DiskPrimitive> record("disk", "A flat disk.");
  record.required("center", &DiskPrimitive::centre_m, point(), "its centre")
      .required("normal", &DiskPrimitive::normal, direction(), "direction that its front faces, any length")
      .required("radius", &DiskPrimitive::radius_m, positive_length(), "its radius");
  return primitive_type(record.type());
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> polygon_type() {
  Record<PolygonPrimitive> record(
      "polygon",
      "A flat polygon, which may be concave; its front is where the vertices run counter-clockwise.");
  record
      .required("vertices", &PolygonPrimitive::vertices_m, list(point(), 3, kMostVertices),
                "its corners in order")
      .check(check_polygon);
  return primitive_type(record.type());
}

}  // namespace

constinit const PrimitiveModel PlanePrimitive::kModel{"plane", plane_type};
constinit const PrimitiveModel DiskPrimitive::kModel{"disk", disk_type};
constinit const PrimitiveModel PolygonPrimitive::kModel{"polygon", polygon_type};

PrimitiveSettings::Built DiskPrimitive::build() const {
  return {geometry::Disk{{}, radius_m}, upright_to(centre_m, normal)};
}

}  // namespace ifov::io
