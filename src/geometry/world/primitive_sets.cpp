#include "geometry/world/primitive_sets.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace ifov::geometry {

using math::Point3;
using math::Vec3;

namespace {

/// Room for `more` values, so that many small additions cost no more than a few large ones.
template <class T>
void grow(std::vector<T>& values, std::size_t more) {
  const std::size_t needed = values.size() + more;
  if (needed > values.capacity())
    values.reserve(values.empty() ? needed : std::max(needed, 2 * values.capacity()));
}

/// Numbers vertices anew, in the order in which they are first asked for.
class OwnNumbers {
 public:
  explicit OwnNumbers(std::size_t most) : table_(std::bit_ceil(most + 1)) {}
  std::uint32_t of(std::uint32_t vertex) {
    std::size_t at = (vertex * 0x9e3779b97f4a7c15ull >> 32) & (table_.size() - 1);
    while (table_[at].vertex != vertex) {
      if (table_[at].vertex == kNoIndex) {
        table_[at] = {vertex, count_};
        return count_++;
      }
      at = (at + 1) & (table_.size() - 1);
    }
    return table_[at].own;
  }

 private:
  struct Entry {
    std::uint32_t vertex = kNoIndex, own = 0;
  };
  std::vector<Entry> table_;
  std::uint32_t count_ = 0;
};

}  // namespace

void TriangleSet::append(const Body& body, const math::Transform& set_from_object) {
  const MeshLists& mesh = body.mesh;
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
    add(mesh, t, moved[i[0]], moved[i[1]], moved[i[2]], flipped,
        {i[0] + first_vertex, i[1] + first_vertex, i[2] + first_vertex});
  }
}

void TriangleSet::take(const MeshLists& mesh, std::span<const std::uint32_t> triangles_of_mesh,
                       const math::Transform& set_from_object) {
  const bool flipped = set_from_object.determinant() < 0.0;
  numbers = triangles_of_mesh;
  OwnNumbers own_numbers(3 * numbers.size());
  std::vector<Point3> moved;
  const auto own_vertex = [&](std::uint32_t vertex) {
    const std::uint32_t own = own_numbers.of(vertex);
    if (own == moved.size()) moved.push_back(set_from_object(mesh.vertices_m[vertex]));
    return own;
  };
  facets.reserve(numbers.size()), tags.reserve(numbers.size()), triangles.reserve(numbers.size());
  for (const std::uint32_t t : numbers) {
    const Triangle& i = mesh.triangles[t];
    const Triangle own{own_vertex(i[0]), own_vertex(i[1]), own_vertex(i[2])};
    add(mesh, t, moved[own[0]], moved[own[1]], moved[own[2]], flipped, own);
  }
  vertices_m.reserve(3 * moved.size());
  for (const Point3& p : moved)
    for (const double c : {p.x, p.y, p.z}) vertices_m.push_back(static_cast<float>(c));
}

void TriangleSet::add(const MeshLists& mesh, std::size_t triangle, Point3 a, Point3 b, Point3 c, bool flipped,
                      const Triangle& corners) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 area = flipped ? cross(ac, ab) : cross(ab, ac);
  const double size = length(area);
  const Vec3 normal = size > 0.0 ? area / size : Vec3{};
  const Point3 middle = a + (ab + ac) / 3.0;
  facets.push_back({normal, normal.x * middle.x + normal.y * middle.y + normal.z * middle.z});
  tags.push_back({mesh.patches[triangle], mesh.slots.empty() ? 0u : mesh.slots[triangle]});
  // What has no area in double must not gain any by the rounding of its vertices.
  triangles.push_back(size > 0.0 ? corners : Triangle{corners[0], corners[0], corners[0]});
}

void AnalyticSet::append(const Body& body, const math::Transform& set_from_object) {
  const math::Transform object_from_set = set_from_object.inverse();
  for (UnitPrimitive p : body.analytic) {
    p.unit_from_object = p.unit_from_object * object_from_set;
    shapes.push_back(p);
  }
}

}  // namespace ifov::geometry
