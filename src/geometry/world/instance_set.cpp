#include "geometry/world/instance_set.h"

#include <algorithm>
#include <cmath>

#include "geometry/world/embree_scene.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

void bound_instance(const RTCBoundsFunctionArguments* a) {
  const WithinCommit order;
  const auto& set = *static_cast<const InstanceSet*>(a->geometryUserPtr);
  const World::Bounds& own = set.targets[(*set.pieces)[a->primID].of].bounds;
  *a->bounds_o = padded(image_of(own, (*set.set_from_scene)[a->primID].inverse()), set.padding_m);
}

/// The rays of Embree's packet in the frame of an instance, eight at most.
void turn_rays(const RayPacket& packet, const math::Transform& map, RTCRayN* rays, unsigned count,
               const int* valid, RTCRay8& turned, int* lanes) {
  for (unsigned i = 0; i < kLanes; ++i) {
    lanes[i] = i < count ? valid[i] : 0;
    if (lanes[i] == 0) {
      turned.org_x[i] = turned.org_y[i] = turned.org_z[i] = 0.0f;
      turned.dir_x[i] = turned.dir_y[i] = turned.dir_z[i] = 1.0f;
      turned.tnear[i] = turned.tfar[i] = turned.time[i] = 0.0f;
      turned.mask[i] = turned.id[i] = turned.flags[i] = 0;
      continue;
    }
    const unsigned k = RTCRayN_id(rays, count, i);
    const Point3 p = map(packet.start(k));
    const Vec3 d = map(packet.direction(k));
    turned.org_x[i] = float(p.x), turned.org_y[i] = float(p.y), turned.org_z[i] = float(p.z);
    turned.dir_x[i] = float(d.x), turned.dir_y[i] = float(d.y), turned.dir_z[i] = float(d.z);
    turned.tnear[i] = RTCRayN_tnear(rays, count, i), turned.tfar[i] = RTCRayN_tfar(rays, count, i);
    turned.time[i] = 0.0f;
    turned.mask[i] = ~0u, turned.id[i] = k, turned.flags[i] = 0;
  }
}

void intersect_instance(const RTCIntersectFunctionNArguments* a) {
  const auto& set = *static_cast<const InstanceSet*>(a->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
  alignas(64) RTCRayHit8 turned;
  alignas(64) int lanes[kLanes];
  turn_rays(packet_of(a->context), (*set.set_from_scene)[a->primID], rays, a->N, a->valid, turned.ray, lanes);
  for (int i = 0; i < kLanes; ++i) turned.hit.geomID[i] = turned.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  a->context->instID[0] = a->primID;
  rtcIntersect8(lanes, set.targets[(*set.pieces)[a->primID].of].scene, a->context, &turned);
  a->context->instID[0] = RTC_INVALID_GEOMETRY_ID;
  // What was met is in the packet; here only the ray's far end counts.
  for (unsigned i = 0; i < a->N; ++i)
    if (lanes[i] != 0) RTCRayN_tfar(rays, a->N, i) = turned.ray.tfar[i];
}

void occlude_instance(const RTCOccludedFunctionNArguments* a) {
  const auto& set = *static_cast<const InstanceSet*>(a->geometryUserPtr);
  alignas(64) RTCRay8 turned;
  alignas(64) int lanes[kLanes];
  turn_rays(packet_of(a->context), (*set.set_from_scene)[a->primID], a->ray, a->N, a->valid, turned, lanes);
  a->context->instID[0] = a->primID;
  rtcOccluded8(lanes, set.targets[(*set.pieces)[a->primID].of].scene, a->context, &turned);
  a->context->instID[0] = RTC_INVALID_GEOMETRY_ID;
  for (unsigned i = 0; i < a->N; ++i)
    if (lanes[i] != 0 && turned.tfar[i] < 0.0f) RTCRayN_tfar(a->ray, a->N, i) = -kFloatInfinity;
}

}  // namespace

World::Bounds image_of(const World::Bounds& b, const math::Transform& map) {
  const Point3 middle = map(b.low_m + (b.high_m - b.low_m) * 0.5);
  const Vec3 half = (b.high_m - b.low_m) * 0.5;
  const Vec3 x = map.column_x() * half.x, y = map.column_y() * half.y, z = map.column_z() * half.z;
  const Vec3 reach{std::abs(x.x) + std::abs(y.x) + std::abs(z.x),
                   std::abs(x.y) + std::abs(y.y) + std::abs(z.y),
                   std::abs(x.z) + std::abs(y.z) + std::abs(z.z)};
  return {middle - reach, middle + reach};
}

void attach_instance_set(RTCDevice device, RTCScene scene, unsigned geometry, const InstanceSet& set) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(set.pieces->size()));
  rtcSetGeometryUserData(g, const_cast<InstanceSet*>(&set));
  rtcSetGeometryBoundsFunction(g, bound_instance, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect_instance);
  rtcSetGeometryOccludedFunction(g, occlude_instance);
  attach(device, scene, g, geometry);
}

}  // namespace ifov::geometry
