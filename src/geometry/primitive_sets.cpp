#include "geometry/primitive_sets.h"

#include <algorithm>
#include <utility>

namespace ifov::geometry {

using math::Point3;
using math::Vec3;

namespace {

/// Room for `more` values, so that many small additions cost no more than a few large ones.
template <class T>
void grow(std::vector<T>& values, std::size_t more) {
  const std::size_t needed = values.size() + more;
  if (needed > values.capacity()) values.reserve(values.empty() ? needed : std::max(needed, 2 * values.capacity()));
}

}  // namespace

void TriangleSet::append(const Body& body, const math::Transform& set_from_object) {
  const TriangleMesh& mesh = body.mesh;
  const bool flipped = set_from_object.determinant() < 0.0;
  const auto first_vertex = static_cast<std::uint32_t>(vertices_m.size() / 3);
  std::vector<Point3> moved;
  moved.reserve(mesh.vertices_m.size());
  grow(vertices_m, 3 * mesh.vertices_m.size());
  for (const Point3& p : mesh.vertices_m) {
    const Point3 q = moved.emplace_back(set_from_object(p));
    for (const double c : {q.x, q.y, q.z}) vertices_m.push_back(static_cast<float>(c));
  }
  grow(facets, mesh.triangles.size());
  grow(tags, mesh.triangles.size());
  grow(triangles, mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& i = mesh.triangles[t];
    const Point3 a = moved[i[0]];
    const Vec3 ab = moved[i[1]] - a, ac = moved[i[2]] - a;
    const Vec3 area = flipped ? cross(ac, ab) : cross(ab, ac);
    const double size = length(area);
    const Vec3 normal = size > 0.0 ? area / size : Vec3{};
    const Point3 middle = a + (ab + ac) / 3.0;
    facets.push_back({normal, normal.x * middle.x + normal.y * middle.y + normal.z * middle.z});
    tags.push_back({body.mesh_patches[t], mesh.slots.empty() ? 0u : mesh.slots[t]});
    // What has no area in double must not gain any by the rounding of its vertices.
    const std::uint32_t a_kept = i[0] + first_vertex;
    triangles.push_back(size > 0.0 ? Triangle{a_kept, i[1] + first_vertex, i[2] + first_vertex}
                                   : Triangle{a_kept, a_kept, a_kept});
  }
}

void AnalyticSet::append(const Body& body, const math::Transform& set_from_object) {
  const math::Transform object_from_set = set_from_object.inverse();
  for (UnitPrimitive p : body.analytic) {
    p.unit_from_object = p.unit_from_object * object_from_set;
    shapes.push_back(p);
  }
}

}  // namespace ifov::geometry
