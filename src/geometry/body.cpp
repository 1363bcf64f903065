#include "geometry/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "geometry/all_pieces.h"
#include "geometry/mesh_chunks.h"
#include "geometry/mesh_topology.h"
#include "geometry/polygon_triangulation.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

bool finite(Point3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void require_size(const char* what, double size_m) {
  if (!(size_m > 0.0) || !std::isfinite(size_m))
    throw InputError(format("{} must be a positive length, found {} m", what, size_m));
}
void require_position(const char* what, Point3 p) {
  if (!finite(p)) throw InputError(format("{} must be finite, found ({}, {}, {})", what, p.x, p.y, p.z));
}

Transform scaled_about(Point3 origin_m, Vec3 factors) {
  return Transform::from_columns({factors.x, 0.0, 0.0}, {0.0, factors.y, 0.0}, {0.0, 0.0, factors.z},
                                 origin_m);
}

/// Bounds, bounding sphere and sides, once everything is in.
void settle_bounds(Body& body) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  World::Bounds& b = body.bounds;
  b = {{inf, inf, inf}, {-inf, -inf, -inf}};
  const auto include = [&](Point3 low, Point3 high) {
    b.low_m = {std::min(b.low_m.x, low.x), std::min(b.low_m.y, low.y), std::min(b.low_m.z, low.z)};
    b.high_m = {std::max(b.high_m.x, high.x), std::max(b.high_m.y, high.y), std::max(b.high_m.z, high.z)};
  };
  for (const UnitPrimitive& p : body.analytic) {
    const World::Bounds part = unit_bounds(p.kind, p.unit_from_object.inverse());
    include(part.low_m, part.high_m);
  }
  for (const Triangle& t : body.mesh.triangles)
    for (const std::uint32_t i : t) include(body.mesh.vertices_m[i], body.mesh.vertices_m[i]);

  body.centre_m = b.low_m + (b.high_m - b.low_m) * 0.5;
  if (body.analytic.size() == 1 && body.mesh.triangles.empty() && body.analytic[0].kind->centred)
    body.centre_m = body.analytic[0].unit_from_object.inverse().origin_m();
  body.radius_m = 0.0;
  for (const UnitPrimitive& p : body.analytic)
    body.radius_m =
        std::max(body.radius_m, unit_reach_m(p.kind, p.unit_from_object.inverse(), body.centre_m));
  for (const Triangle& t : body.mesh.triangles)
    for (const std::uint32_t i : t)
      body.radius_m = std::max(body.radius_m, length(body.mesh.vertices_m[i] - body.centre_m));
  body.half_sides_m =
      oriented_extent(body.analytic.empty() ? body.mesh.vertices_m : std::span<const Point3>(), body.bounds);
}

Body analytic_body(UnitKind kind, const Transform& object_from_unit, Point3 pilot_in_unit, bool solid) {
  Body body;
  body.analytic.push_back({object_from_unit.inverse(), 0, 0, kind});
  body.patch_count = unit_face_count(kind);
  body.pilot_point_m = object_from_unit(pilot_in_unit);
  body.pilot_is_solid = solid;
  settle_bounds(body);
  body.pilot_weight = 4.0 * std::numbers::pi * body.radius_m * body.radius_m;
  return body;
}

Body make(const PlacedUnit& placed) {
  return analytic_body(*placed.unit, placed.object_from_unit, placed.pilot_in_unit, placed.solid);
}

Body make(const Plane&) { throw InputError("a plane cannot be part of a prototype"); }

Body make(const Box& box) {
  require_position("a corner of a box", box.low_m);
  require_position("a corner of a box", box.high_m);
  const Vec3 size = box.high_m - box.low_m;
  for (const double s : {size.x, size.y, size.z}) require_size("the side of a box", s);
  return analytic_body(UnitKind::box, scaled_about(box.low_m + size * 0.5, size * 0.5), {}, true);
}

Body make(const Sphere& sphere) {
  require_position("the centre of a sphere", sphere.centre_m);
  require_size("the radius of a sphere", sphere.radius_m);
  const double r = sphere.radius_m;
  return analytic_body(UnitKind::sphere, scaled_about(sphere.centre_m, {r, r, r}), {}, true);
}

Body make(const Hemisphere& hemisphere) {
  require_position("the centre of a hemisphere", hemisphere.centre_m);
  require_size("the radius of a hemisphere", hemisphere.radius_m);
  const double r = hemisphere.radius_m;
  // A ray towards a point below the shell meets the shell from above, from the sides and through the open
  // floor.
  return analytic_body(UnitKind::hemisphere, scaled_about(hemisphere.centre_m, {r, r, r}), {0.0, 0.0, 0.5},
                       false);
}

Body make(const Cylinder& cylinder) {
  require_position("the base of a cylinder", cylinder.base_m);
  require_size("the radius of a cylinder", cylinder.radius_m);
  require_size("the height of a cylinder", cylinder.height_m);
  const Transform map =
      scaled_about(cylinder.base_m, {cylinder.radius_m, cylinder.radius_m, cylinder.height_m});
  if (cylinder.capped) return analytic_body(UnitKind::cylinder, map, {0.0, 0.0, 0.5}, true);
  return analytic_body(UnitKind::open_cylinder, map, {1.0, 0.0, 0.5}, false);
}

Body make(const Disk& disk) {
  require_position("the centre of a disk", disk.centre_m);
  require_size("the radius of a disk", disk.radius_m);
  const double r = disk.radius_m;
  return analytic_body(UnitKind::disk, scaled_about(disk.centre_m, {r, r, r}), {}, false);
}

void require_vertices(std::span<const Point3> vertices_m) {
  const auto good = [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;  // becomes NaN
    for (std::size_t v = begin; v < end; ++v)
      sum += 0.0 * vertices_m[v].x + 0.0 * vertices_m[v].y + 0.0 * vertices_m[v].z;
    return sum == 0.0;
  };
  if (all_pieces(vertices_m.size(), good)) return;
  for (const Point3& p : vertices_m) require_position("a vertex of a mesh", p);
}

void require_indices(const char* what, std::span<const Triangle> corners, std::size_t count, bool optional) {
  const std::uint32_t shift = optional ? 1 : 0;  // which makes kNoIndex 0
  const auto good = [&](std::size_t begin, std::size_t end) {
    std::uint32_t largest = 0;
    for (std::size_t t = begin; t < end; ++t)
      for (const std::uint32_t i : corners[t]) largest = std::max(largest, i + shift);
    return begin == end || largest < count + shift;
  };
  if (all_pieces(corners.size(), good)) return;
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (const std::uint32_t i : corners[t])
      if (i >= count && !(optional && i == kNoIndex))
        throw InputError(format("triangle {} of a mesh names {} {} of {}", t, what, i, count));
}

/// Parity of the crossings of a slanted line from `p`: inside a closed mesh it is odd.
bool inside(const MeshLists& mesh, Point3 p) {
  const Vec3 d = math::normalized({0.12345678, 0.35467281, 0.92876543});
  bool odd = false;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]] - p, b = mesh.vertices_m[t[1]] - p, c = mesh.vertices_m[t[2]] - p;
    const double u = dot(cross(b, c), d), v = dot(cross(c, a), d), w = dot(cross(a, b), d);
    const bool all_in = (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
    const Vec3 n = cross(b - a, c - a);
    if (all_in && dot(n, a) * dot(n, d) > 0.0) odd = !odd;
  }
  return odd;
}

Body mesh_body(TriangleMesh mesh, bool one_patch) {
  check_mesh(lists_of(mesh));
  MeshTopology topology = topology_of(mesh.vertices_m, mesh.triangles);
  Body body;
  body.patch_count = topology.patch_count;
  if (one_patch) {
    std::fill(topology.patches.begin(), topology.patches.end(), 0u);
    body.patch_count = 1;
  }
  if (!topology.loose) body.surface_triangles = mesh.triangles.size();
  std::uint32_t slots = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(mesh.slot_names.size()));
  for (const std::uint32_t s : mesh.slots) slots = std::max(slots, s + 1);
  body.slot_count = slots;
  body.mesh = keep_mesh(std::move(mesh), std::move(topology.patches));
  divide(body.mesh);
  settle_bounds(body);

  double largest = -1.0;
  for (const Triangle& t : body.mesh.triangles) {
    const Point3 a = body.mesh.vertices_m[t[0]], b = body.mesh.vertices_m[t[1]],
                 c = body.mesh.vertices_m[t[2]];
    const double area = 0.5 * length(cross(b - a, c - a));
    if (area > largest) largest = area, body.pilot_point_m = a + ((b - a) + (c - a)) / 3.0;
  }
  body.pilot_weight = largest;
  if (topology.closed && inside(body.mesh, body.centre_m)) {
    body.pilot_point_m = body.centre_m;
    body.pilot_is_solid = true;
    body.pilot_weight = 4.0 * std::numbers::pi * body.radius_m * body.radius_m;
  }
  return body;
}

Body make(TriangleMesh mesh) { return mesh_body(std::move(mesh), false); }

Body make(const Polygon& polygon) {
  const std::vector<Point3>& v = polygon.vertices_m;
  if (v.size() < 3) throw InputError(format("a polygon needs at least 3 vertices, found {}", v.size()));
  for (const Point3& p : v) require_position("a vertex of a polygon", p);
  const Vec3 area = polygon_area_vector(v);
  double size = 0.0;
  for (const Point3& p : v) size = std::max(size, length(p - v[0]));
  if (!(length(area) > 1e-12 * size * size)) throw InputError("a polygon has no area");
  const Vec3 normal = normalized(area);
  double lift = 0.0;
  for (const Point3& p : v) lift = std::max(lift, std::abs(dot(normal, p - v[0])));
  if (lift > 1e-6 * size)
    throw InputError(format("a polygon is not planar: a vertex lies {} m off its plane", lift));

  TriangleMesh mesh;
  mesh.vertices_m = v;
  mesh.triangles = triangulate_polygon(v);
  // Texture coordinates over the polygon's own rectangle: u along the first edge, v to its left.
  Vec3 along{};
  for (std::size_t k = 1; k < v.size() && !(length(along) > 1e-9 * size); ++k) along = v[k] - v[0];
  const Vec3 x = normalized(along), y = cross(normal, x);
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;
  for (const Point3& p : v) {
    x_low = std::min(x_low, dot(x, p - v[0])), x_high = std::max(x_high, dot(x, p - v[0]));
    y_low = std::min(y_low, dot(y, p - v[0])), y_high = std::max(y_high, dot(y, p - v[0]));
  }
  for (const Point3& p : v)
    mesh.uvs.push_back(
        {(dot(x, p - v[0]) - x_low) / (x_high - x_low), (dot(y, p - v[0]) - y_low) / (y_high - y_low)});
  return mesh_body(std::move(mesh), true);  // slivers of no area would be patches of their own
}

/// Attributes of a part, indices shifted; corners of triangles without the attribute hold kNoIndex.
template <class T, class Map>
void append_attribute(std::vector<T>& values, std::vector<Triangle>& corners, std::size_t triangles_before,
                      std::span<const T> part_values, std::span<const Triangle> part_corners,
                      std::span<const Triangle> part_triangles, bool flipped, const Map& map) {
  if (part_values.empty() && values.empty()) return;
  corners.resize(triangles_before, Triangle{kNoIndex, kNoIndex, kNoIndex});
  const auto shift = static_cast<std::uint32_t>(values.size());
  for (std::size_t t = 0; t < part_triangles.size(); ++t) {
    Triangle c{kNoIndex, kNoIndex, kNoIndex};
    if (!part_values.empty()) {
      c = part_corners.empty() ? part_triangles[t] : part_corners[t];
      for (std::uint32_t& i : c)
        if (i != kNoIndex) i += shift;
    }
    if (flipped) std::swap(c[1], c[2]);
    corners.push_back(c);
  }
  for (const T& value : part_values) values.push_back(map(value));
}

}  // namespace

void check_mesh(const MeshLists& mesh) {
  const std::size_t n = mesh.triangles.size();
  if (n == 0) throw InputError("a mesh has no triangles");
  if (n >= kNoIndex || mesh.vertices_m.size() >= kNoIndex) throw InputError("a mesh has too many triangles");
  require_vertices(mesh.vertices_m);
  require_indices("vertex", mesh.triangles, mesh.vertices_m.size(), false);
  require_indices("normal", mesh.normal_corners, mesh.normals.size(), true);
  require_indices("texture coordinate", mesh.uv_corners, mesh.uvs.size(), true);
  const auto same_length = [&](const char* what, std::size_t length) {
    if (length != 0 && length != n)
      throw InputError(format("a mesh has {} {} for {} triangles", length, what, n));
  };
  same_length("material slots", mesh.slots.size());
  same_length("normal corners", mesh.normal_corners.size());
  same_length("texture corners", mesh.uv_corners.size());
  if (!mesh.normals.empty() && mesh.normal_corners.empty() && mesh.normals.size() != mesh.vertices_m.size())
    throw InputError("a mesh without normal corners needs one normal per vertex");
  if (!mesh.uvs.empty() && mesh.uv_corners.empty() && mesh.uvs.size() != mesh.vertices_m.size())
    throw InputError("a mesh without texture corners needs one texture coordinate per vertex");
}

Body body_of(Shape shape) {
  return std::visit([](auto&& s) { return make(std::forward<decltype(s)>(s)); }, std::move(shape));
}

void JoinedBody::add(const Body& part, const Transform& whole_from_part,
                     std::span<const std::uint32_t> slots) {
  const auto slot = [&](std::uint32_t s) { return slots.empty() ? 0u : slots[s]; };
  const bool flipped = whole_from_part.determinant() < 0.0;
  const Transform part_from_whole = whole_from_part.inverse();

  for (const UnitPrimitive& p : part.analytic)
    whole_.analytic.push_back(
        {p.unit_from_object * part_from_whole, p.patch + whole_.patch_count, slot(p.slot), p.kind});

  const std::size_t before = mesh_.triangles.size();
  if (mesh_.vertices_m.size() + part.mesh.vertices_m.size() >= kNoIndex)
    throw InputError("a prototype is too large");
  const auto moved = [&](const auto& value) { return whole_from_part(value); };
  append_attribute(mesh_.normals, mesh_.normal_corners, before, part.mesh.normals, part.mesh.normal_corners,
                   part.mesh.triangles, flipped, moved);
  append_attribute(mesh_.uvs, mesh_.uv_corners, before, part.mesh.uvs, part.mesh.uv_corners,
                   part.mesh.triangles, flipped, [](Uv uv) { return uv; });
  const auto shift = static_cast<std::uint32_t>(mesh_.vertices_m.size());
  for (const Point3& p : part.mesh.vertices_m) mesh_.vertices_m.push_back(whole_from_part(p));
  for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t) {
    Triangle c = part.mesh.triangles[t];
    for (std::uint32_t& i : c) i += shift;
    if (flipped) std::swap(c[1], c[2]);
    mesh_.triangles.push_back(c);
    mesh_.slots.push_back(slot(part.mesh.slots.empty() ? 0u : part.mesh.slots[t]));
    patches_.push_back(part.mesh.patches[t] + whole_.patch_count);
  }

  whole_.patch_count += part.patch_count;
  whole_.surface_triangles += part.surface_triangles;
  const double stretch = largest_stretch(whole_from_part);
  const double weight = part.pilot_weight * stretch * stretch;
  if (std::pair(part.pilot_is_solid, weight) > std::pair(whole_.pilot_is_solid, whole_.pilot_weight)) {
    whole_.pilot_is_solid = part.pilot_is_solid;
    whole_.pilot_weight = weight;
    whole_.pilot_point_m = whole_from_part(part.pilot_point_m);
  }
}

Body JoinedBody::take() && {
  whole_.mesh = keep_mesh(std::move(mesh_), std::move(patches_));
  settle_bounds(whole_);
  return std::move(whole_);
}

}  // namespace ifov::geometry
