// Queries of the world.
#include "geometry/world/embree_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/world/flush_denormals.h"

namespace ifov::geometry {
namespace {

using math::Normal3;
using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Outward normal in the scene of one known in a frame `frame_from_scene` leads to.
Normal3 normal_in_scene(const Transform& frame_from_scene, Normal3 n) {
  const Vec3 v = n.as_vector();
  return math::as_normal(
      math::normalized({dot(frame_from_scene.column_x(), v), dot(frame_from_scene.column_y(), v),
                        dot(frame_from_scene.column_z(), v)}));
}

/// Barycentric weights of a point in the plane of a triangle.
std::array<double, 3> weights(Point3 a, Point3 b, Point3 c, Point3 p) {
  const Vec3 n = cross(b - a, c - a);
  const double whole = dot(n, n);
  const double wb = dot(cross(p - a, c - a), n) / whole, wc = dot(cross(b - a, p - a), n) / whole;
  return {1.0 - wb - wc, wb, wc};
}

const Triangle& corners(std::span<const Triangle> own, const MeshLists& mesh, std::uint32_t triangle) {
  return own.empty() ? mesh.triangles[triangle] : own[triangle];
}
bool complete(const Triangle& t) { return t[0] != kNoIndex && t[1] != kNoIndex && t[2] != kNoIndex; }

}  // namespace

InstanceTable EmbreeWorld::table() const {
  return {set_from_scene_.data(), instances_.data(), copies_.data()};
}

bool EmbreeWorld::load(RayPacket& packet, std::span<const Ray> rays, double* shift, RTCRay8& embree,
                       int* valid) const {
  const std::size_t count = rays.size();
  alignas(64) double t_min[kLanes], t_max[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Ray& ray = rays[std::min(k, count - 1)];
    packet.x[k] = ray.origin_m.x - centre_m_.x, packet.y[k] = ray.origin_m.y - centre_m_.y,
    packet.z[k] = ray.origin_m.z - centre_m_.z;
    packet.dx[k] = ray.direction.x, packet.dy[k] = ray.direction.y, packet.dz[k] = ray.direction.z;
    t_min[k] = ray.t_min_m, t_max[k] = ray.t_max_m;
  }
  alignas(64) double enter[kLanes], leave[kLanes];
  const auto slab = [](double low, double high, double p, double d, double& first, double& last) {
    const double inverse = 1.0 / (d == 0.0 ? 1e-300 : d);
    const double a = (low - p) * inverse, b = (high - p) * inverse;
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  };
  for (std::size_t k = 0; k < kLanes; ++k) {
    double first = t_min[k], last = t_max[k];
    slab(padded_.low_m.x, padded_.high_m.x, packet.x[k], packet.dx[k], first, last);
    slab(padded_.low_m.y, padded_.high_m.y, packet.y[k], packet.dy[k], first, last);
    slab(padded_.low_m.z, padded_.high_m.z, packet.z[k], packet.dz[k], first, last);
    enter[k] = first, leave[k] = last;
  }
  // The ray starts a little before the scene's box and before t_min, in double; then it becomes float.
  const double before = 0x1p-5 * window_m_;
  int any = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const bool meets = enter[k] <= leave[k] && scene_;
    const double s = (meets ? enter[k] : t_min[k]) - before;
    shift[k] = s;
    packet.x[k] += s * packet.dx[k], packet.y[k] += s * packet.dy[k], packet.z[k] += s * packet.dz[k];
    packet.low[k] = t_min[k] - s, packet.high[k] = t_max[k] - s;
    packet.near[k] = kInfinity, packet.exact[k] = kUnknown;
    packet.best[k].kind = Candidate::none;
    packet.same_count[k] = 0;
    valid[k] = meets && k < count ? -1 : 0;
    any |= valid[k];
    embree.org_x[k] = float(packet.x[k]), embree.org_y[k] = float(packet.y[k]),
    embree.org_z[k] = float(packet.z[k]);
    embree.dir_x[k] = float(packet.dx[k]), embree.dir_y[k] = float(packet.dy[k]),
    embree.dir_z[k] = float(packet.dz[k]);
    embree.tnear[k] = 0.0f, embree.tfar[k] = float(leave[k] - s + window_m_), embree.time[k] = 0.0f;
    embree.mask[k] = ~0u, embree.id[k] = unsigned(k), embree.flags[k] = 0;
  }
  packet.visits = visits_.runs.empty() ? nullptr : &visits_;
  if (packet.visits != nullptr)
    for (std::size_t k = 0; k < kLanes; ++k) packet.time_s[k] = rays[std::min(k, count - 1)].time_s;
  packet.window_m = window_m_;
  packet.same_m = same_m_;
  packet.table = table();
  rtcInitIntersectContext(&packet.context);
  return any != 0;
}

void EmbreeWorld::meet_planes(RayPacket& packet, std::size_t count) const {
  for (std::uint32_t i = 0; i < planes_.size(); ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      const double t = (planes_[i].z_m - packet.z[k]) / packet.dz[k];
      const Candidate c{Candidate::plane, RTC_INVALID_GEOMETRY_ID, i, 0, &planes_[i].object};
      if (!packet.within(k, t) || !packet.is_there(k, c)) continue;
      packet.take(k, t, t, c);
    }
  }
}

void EmbreeWorld::intersect(std::span<const Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, holes());
}

void EmbreeWorld::intersect_uncut(std::span<const Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, nullptr);
}

void EmbreeWorld::intersect(std::span<const Ray> rays, std::span<SurfacePoint> hits,
                            const HoleTest* holes) const {
  const FlushDenormals flush;
  alignas(64) RTCRayHit8 embree;
  alignas(64) int valid[kLanes];
  RayPacket packet;
  packet.holes = holes;
  double shift[kLanes];
  for (std::size_t begin = 0; begin < rays.size(); begin += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, rays.size() - begin);
    const bool any = load(packet, rays.subspan(begin, count), shift, embree.ray, valid);
    if (!planes_.empty()) {
      meet_planes(packet, count);
      for (std::size_t k = 0; k < count; ++k)
        embree.ray.tfar[k] = std::min(embree.ray.tfar[k], float(packet.near[k] + window_m_));
    }
    if (any) {
      for (std::size_t k = 0; k < kLanes; ++k)
        embree.hit.geomID[k] = embree.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect8(valid, scene_.get(), &packet.context, &embree);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t shared_with = packet.settle(k);
      finish(packet, k, rays[begin + k], shift[k], hits[begin + k]);
      hits[begin + k].shared_with = shared_with;
    }
  }
  late_failure_.rethrow_if_any();
}

void EmbreeWorld::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  const FlushDenormals flush;
  alignas(64) RTCRay8 embree;
  alignas(64) int valid[kLanes];
  RayPacket packet;
  packet.holes = holes();
  double shift[kLanes];
  for (std::size_t begin = 0; begin < rays.size(); begin += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, rays.size() - begin);
    bool any = load(packet, rays.subspan(begin, count), shift, embree, valid);
    if (!planes_.empty()) {
      meet_planes(packet, count);
      any = false;
      for (std::size_t k = 0; k < count; ++k) {
        if (packet.best[k].kind == Candidate::plane) valid[k] = 0;
        any |= valid[k] != 0;
      }
    }
    if (any) rtcOccluded8(valid, scene_.get(), &packet.context, &embree);
    for (std::size_t k = 0; k < count; ++k)
      blocked[begin + k] =
          packet.best[k].kind == Candidate::plane || (valid[k] != 0 && embree.tfar[k] < 0.0f);
  }
  late_failure_.rethrow_if_any();
}

void EmbreeWorld::finish(const RayPacket& packet, std::size_t k, const Ray& ray, double shift,
                         SurfacePoint& hit) const {
  const Candidate& c = packet.best[k];
  if (c.kind == Candidate::none) {
    hit = SurfacePoint{};
    return;
  }
  double t = packet.exact[k];
  if (c.kind == Candidate::triangle) {
    if (std::isnan(t))
      t = packet.facet_distance(k, *static_cast<const TriangleSet*>(c.set), c.instance, c.prim);
    // A ray within the plane of a triangle meets that plane anywhere: then Embree's distance is the better
    // one.
    if (!(std::abs(t - packet.near[k]) <= 64.0 * window_m_)) t = packet.near[k];
  }
  hit.bend = Bend::none;
  hit.distance_m = shift + t;
  hit.position_m = ray.origin_m + ray.direction * hit.distance_m;
  hit.u = hit.v = 0.0;
  if (c.kind == Candidate::triangle)
    finish_triangle(c, hit);
  else if (c.kind == Candidate::field)
    finish_field(c, hit);
  else if (c.kind == Candidate::analytic)
    finish_analytic(packet, k, hit);
  else
    finish_plane(c, hit);
  hit.front = dot(hit.geometric_normal, ray.direction) < 0.0;
}

void EmbreeWorld::finish_plane(const Candidate& c, SurfacePoint& hit) const {
  const PlaneObject& plane = planes_[c.prim];
  const Point3 p = plane.object_from_scene(hit.position_m);
  hit.u = p.x, hit.v = p.y;
  hit.geometric_normal = hit.shading_normal = {0.0, 0.0, 1.0};
  hit.instance = plane.object;
  hit.patch = hit.primitive = 0;
  hit.material = plane.material;
  hit.offset_m = analytic_offset(hit);
}

void EmbreeWorld::finish_triangle(const Candidate& c, SurfacePoint& hit) const {
  const auto& set = *static_cast<const TriangleSet*>(c.set);
  hit.bend = Bend::facet;
  const Normal3 n = math::as_normal(set.facets[c.prim].normal);
  const FacetTag tag = set.tags[c.prim];
  const bool copied = c.instance == RTC_INVALID_GEOMETRY_ID;
  const std::uint32_t owner = set.owner(c.prim), number = set.number(c.prim);
  const Piece& piece = copied ? copies_[owner] : instances_[c.instance];
  hit.geometric_normal = copied ? n : normal_in_scene(set_from_scene_[c.instance], n);
  hit.shading_normal = hit.geometric_normal;
  hit.instance = piece.object;
  hit.primitive = number + piece.first_triangle;
  hit.patch = piece.first_patch + tag.patch;
  hit.material = materials_[piece.materials + tag.slot];
  hit.offset_m = std::max(triangle_offset_m_, analytic_offset(hit));
  if (attributes_of_.empty() || attributes_of_[piece.of] == kNoIndex) return;
  const Attributes& kept = attributes_[attributes_of_[piece.of]];
  if (copied) {
    const Transform& map = body_from_scene_[copy_map_of_[owner]];
    apply_attributes(kept, map, map(hit.position_m), number - piece.set_triangle, hit);
  } else {
    const Transform& map = set_from_scene_[c.instance];
    const Point3 in_set = map(Point3{} + (hit.position_m - centre_m_));
    apply_attributes(kept, map, in_set + (kept.centre_m - Point3{}), number, hit);
  }
}

bool EmbreeWorld::is_open(const RayPacket& packet, std::size_t k, const TriangleSet& set,
                          std::uint32_t instance, std::uint32_t prim, double t, double seen) const {
  const Piece& piece = instance == RTC_INVALID_GEOMETRY_ID ? copies_[set.owner(prim)] : instances_[instance];
  const CutOut* cut_out = cut_outs_[materials_[piece.materials + set.tags[prim].slot]].get();
  if (cut_out == nullptr) return false;
  if (std::isnan(t)) t = packet.facet_distance(k, set, instance, prim);
  if (!(std::abs(t - seen) <= 64.0 * window_m_)) t = seen;
  SurfacePoint hit;
  hit.position_m = centre_m_ + (packet.start(k) + packet.direction(k) * t - Point3{});
  finish_triangle({Candidate::triangle, instance, prim, 0, &set}, hit);
  return cut_out->is_open(hit.position_m, hit.u, hit.v);
}

void EmbreeWorld::apply_attributes(const Attributes& kept, const Transform& mesh_from_scene, Point3 in_mesh,
                                   std::uint32_t triangle, SurfacePoint& hit) const {
  const MeshLists& mesh = kept.mesh;
  const Triangle& v = mesh.triangles[triangle];
  const auto w = weights(mesh.vertices_m[v[0]], mesh.vertices_m[v[1]], mesh.vertices_m[v[2]], in_mesh);
  if (!mesh.uvs.empty()) {
    const Triangle& i = corners(mesh.uv_corners, mesh, triangle);
    if (complete(i)) {
      const Uv a = mesh.uvs[i[0]], b = mesh.uvs[i[1]], c = mesh.uvs[i[2]];
      hit.u = w[0] * a.u + w[1] * b.u + w[2] * c.u;
      hit.v = w[0] * a.v + w[1] * b.v + w[2] * c.v;
    }
  }
  if (!mesh.normals.empty()) {
    const Triangle& i = corners(mesh.normal_corners, mesh, triangle);
    if (!complete(i)) return;
    hit.bend = Bend::smooth;
    const Vec3 n = mesh.normals[i[0]].as_vector() * w[0] + mesh.normals[i[1]].as_vector() * w[1] +
                   mesh.normals[i[2]].as_vector() * w[2];
    const Normal3 shading = normal_in_scene(mesh_from_scene, math::as_normal(n));
    const double side = dot(shading, hit.geometric_normal.as_vector());
    if (std::isfinite(side)) hit.shading_normal = side < 0.0 ? -shading : shading;
  }
}

void EmbreeWorld::finish_field(const Candidate& c, SurfacePoint& hit) const {
  const auto& placed = *static_cast<const PlacedField*>(c.set);
  const Transform& map = placed.field_from_centred;
  const Point3 at = map(Point3{} + (hit.position_m - centre_m_));
  hit.geometric_normal = normal_in_scene(map, placed.field->normal(c.prim));
  const Normal3 shading = normal_in_scene(map, placed.field->shading_normal(c.prim, at));
  hit.shading_normal = dot(shading, hit.geometric_normal.as_vector()) < 0.0 ? -shading : shading;
  hit.instance = placed.object;
  hit.bend = Bend::field;
  hit.primitive = c.prim;
  hit.patch = 0;
  hit.material = placed.material;
  hit.offset_m = std::max(triangle_offset_m_, analytic_offset(hit));
}

void EmbreeWorld::finish_analytic(const RayPacket& packet, std::size_t k, SurfacePoint& hit) const {
  const Candidate& c = packet.best[k];
  const auto& set = *static_cast<const AnalyticSet*>(c.set);
  const UnitPrimitive& shape = set.shapes[c.prim];
  Point3 p = packet.start(k) + packet.direction(k) * packet.exact[k];
  const bool copied = c.instance == RTC_INVALID_GEOMETRY_ID;
  const Piece& piece = copied ? copies_[set.owners[c.prim]] : instances_[c.instance];
  Normal3 n;
  if (copied) {
    p = shape.unit_from_object(p);
    n = normal_in_scene(shape.unit_from_object, unit_normal(shape.kind, c.face, p));
  } else {
    const Transform& map = set_from_scene_[c.instance];
    p = shape.unit_from_object(map(p));
    n = normal_in_scene(map, normal_in_scene(shape.unit_from_object, unit_normal(shape.kind, c.face, p)));
  }
  if (is_round(shape.kind, c.face)) hit.bend = Bend::round;
  const Uv uv = unit_uv(shape.kind, c.face, p);
  hit.u = uv.u, hit.v = uv.v;
  hit.geometric_normal = hit.shading_normal = n;
  hit.instance = piece.object;
  hit.primitive = c.prim + piece.first_analytic;
  hit.patch = piece.first_patch + shape.patch + c.face;
  hit.material = materials_[piece.materials + shape.slot];
  hit.offset_m = analytic_offset(hit);
}

double EmbreeWorld::analytic_offset(const SurfacePoint& hit) const {
  const Point3 p = hit.position_m;
  return 1e-9 + 1e-12 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + hit.distance_m + scale_m_);
}

}  // namespace ifov::geometry
