#include "geometry/world/embree_scene.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "core/call_scope.h"
#include "core/error.h"
#include "geometry/world/instance_set.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

#ifdef __SANITIZE_THREAD__
std::atomic<int> commits{0}, calls_back{0};
#endif

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw SystemError("out of memory while building the ray tracer's tree");
  if (error != RTC_ERROR_NONE) throw SystemError(format("the ray tracer reports error {}", int(error)));
}

/// Embree's rays carry their lane number as their id. The ray's far end moves to the hit and a window beyond
/// it, so that whatever might be nearer in double is proposed too.
void propose_triangle(const RTCFilterFunctionNArguments* a) {
  RayPacket& packet = packet_of(a->context);
  const auto& set = *static_cast<const TriangleSet*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(a->ray, a->N, i);
    const double seen = double(RTCRayN_tfar(a->ray, a->N, i));
    const Candidate c{Candidate::triangle, RTCHitN_instID(a->hit, a->N, i, 0),
                      RTCHitN_primID(a->hit, a->N, i), 0, &set};
    double t = kUnknown;
    bool taken = packet.is_there(k, c);
    if (taken && !packet.clearly_within(k, seen)) {
      t = packet.facet_distance(k, set, c.instance, c.prim);
      taken = packet.within(k, t);
    }
    if (taken && packet.holes != nullptr)
      taken = !packet.holes->is_open(packet, k, set, c.instance, c.prim, t, seen);
    if (taken && packet.take(k, seen, t, c)) {
      __builtin_prefetch(&set.facets[c.prim]);
      __builtin_prefetch(&set.tags[c.prim]);
      RTCRayN_tfar(a->ray, a->N, i) = static_cast<float>(seen + packet.window_m);
    } else {
      a->valid[i] = 0;
    }
  }
}

void propose_occluder(const RTCFilterFunctionNArguments* a) {
  const RayPacket& packet = packet_of(a->context);
  const auto& set = *static_cast<const TriangleSet*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(a->ray, a->N, i);
    const double seen = double(RTCRayN_tfar(a->ray, a->N, i));
    const unsigned instance = RTCHitN_instID(a->hit, a->N, i, 0), prim = RTCHitN_primID(a->hit, a->N, i);
    double t = kUnknown;
    bool blocks = packet.is_there(k, {Candidate::triangle, instance, prim, 0, &set});
    if (blocks && !packet.clearly_within(k, seen)) {
      t = packet.facet_distance(k, set, instance, prim);
      blocks = packet.within(k, t);
    }
    if (blocks && packet.holes != nullptr)
      blocks = !packet.holes->is_open(packet, k, set, instance, prim, t, seen);
    if (!blocks) a->valid[i] = 0;
  }
}

/// The shape in double against lane `k`, up to `t_max`.
UnitHit meet(const RayPacket& packet, std::size_t k, const UnitPrimitive& shape, unsigned instance,
             double t_max) {
  Point3 p = packet.start(k);
  Vec3 d = packet.direction(k);
  if (instance != RTC_INVALID_GEOMETRY_ID) {
    const math::Transform& map = packet.table.set_from_scene[instance];
    p = map(p), d = map(d);
  }
  return intersect_unit(shape.kind, shape.unit_from_object(p), shape.unit_from_object(d), packet.low[k],
                        t_max);
}

void intersect_analytic(const RTCIntersectFunctionNArguments* a) {
  RayPacket& packet = packet_of(a->context);
  const auto& set = *static_cast<const AnalyticSet*>(a->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
  const unsigned instance = a->context->instID[0];
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(rays, a->N, i);
    const UnitHit hit = meet(packet, k, set.shapes[a->primID], instance, packet.high[k]);
    const Candidate c{Candidate::analytic, instance, a->primID, hit.face, &set};
    if (hit.t < packet.high[k] && packet.is_there(k, c) && packet.take(k, hit.t, hit.t, c))
      RTCRayN_tfar(rays, a->N, i) =
          std::min(RTCRayN_tfar(rays, a->N, i), static_cast<float>(hit.t + packet.window_m));
  }
}

void occlude_analytic(const RTCOccludedFunctionNArguments* a) {
  const RayPacket& packet = packet_of(a->context);
  const auto& set = *static_cast<const AnalyticSet*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(a->ray, a->N, i);
    const unsigned instance = a->context->instID[0];
    const UnitHit hit = meet(packet, k, set.shapes[a->primID], instance, packet.high[k]);
    if (hit.t < packet.high[k] &&
        packet.is_there(k, {Candidate::analytic, instance, a->primID, hit.face, &set}))
      RTCRayN_tfar(a->ray, a->N, i) = -kFloatInfinity;
  }
}

/// Lane `k` against a block of a height field, between the ray's ends.
HeightField::Hit meet(const RayPacket& packet, std::size_t k, const PlacedField& placed, unsigned block) {
  return placed.field->meet(block, placed.field_from_centred(packet.start(k)),
                            placed.field_from_centred(packet.direction(k)), packet.low[k], packet.high[k]);
}

void intersect_field(const RTCIntersectFunctionNArguments* a) {
  RayPacket& packet = packet_of(a->context);
  const auto& placed = *static_cast<const PlacedField*>(a->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(rays, a->N, i);
    const HeightField::Hit hit = meet(packet, k, placed, a->primID);
    const Candidate c{Candidate::field, RTC_INVALID_GEOMETRY_ID, hit.triangle, 0, &placed};
    if (hit.t < packet.high[k] && packet.is_there(k, c) && packet.take(k, hit.t, hit.t, c))
      RTCRayN_tfar(rays, a->N, i) =
          std::min(RTCRayN_tfar(rays, a->N, i), static_cast<float>(hit.t + packet.window_m));
  }
}

void occlude_field(const RTCOccludedFunctionNArguments* a) {
  const RayPacket& packet = packet_of(a->context);
  const auto& placed = *static_cast<const PlacedField*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const std::size_t k = RTCRayN_id(a->ray, a->N, i);
    const HeightField::Hit hit = meet(packet, k, placed, a->primID);
    if (hit.t < packet.high[k] &&
        packet.is_there(k, {Candidate::field, RTC_INVALID_GEOMETRY_ID, hit.triangle, 0, &placed}))
      RTCRayN_tfar(a->ray, a->N, i) = -kFloatInfinity;
  }
}

void bound_field(const RTCBoundsFunctionArguments* a) {
  const WithinCommit order;
  const auto& placed = *static_cast<const PlacedField*>(a->geometryUserPtr);
  const World::Bounds own = placed.field->block_bounds(a->primID);
  *a->bounds_o =
      padded(own.low_m.z <= own.high_m.z ? image_of(own, placed.centred_from_field) : own, placed.padding_m);
}

void bound_analytic(const RTCBoundsFunctionArguments* a) {
  const WithinCommit order;
  const auto& set = *static_cast<const AnalyticSet*>(a->geometryUserPtr);
  const UnitPrimitive& shape = set.shapes[a->primID];
  *a->bounds_o = padded(unit_bounds(shape.kind, shape.unit_from_object.inverse()), set.padding_m);
}

}  // namespace

RTCBounds padded(const World::Bounds& box, double padding_m) {
  if (!(box.low_m.z <= box.high_m.z))
    return {kFloatInfinity,  kFloatInfinity,  kFloatInfinity,  0.0f,
            -kFloatInfinity, -kFloatInfinity, -kFloatInfinity, 0.0f};
  const auto down = [&](double v) {
    return std::nextafter(static_cast<float>(v - padding_m), -kFloatInfinity);
  };
  const auto up = [&](double v) { return std::nextafter(static_cast<float>(v + padding_m), kFloatInfinity); };
  return {down(box.low_m.x), down(box.low_m.y), down(box.low_m.z), 0.0f,
          up(box.high_m.x),  up(box.high_m.y),  up(box.high_m.z),  0.0f};
}

void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, unsigned number) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
  check(device);
}

EmbreeDevice make_device(int threads, std::atomic<std::int64_t>& bytes) {
  const std::string config = threads > 0 ? format("isa=avx2,threads={}", threads) : std::string("isa=avx2");
  EmbreeDevice device(rtcNewDevice(config.c_str()));
  if (!device)
    throw SystemError(
        rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU
            ? "the ray tracer cannot start: it needs a processor with AVX2"
            : "the ray tracer cannot start: there is too little memory, or no thread can be made");
  const auto count = [](void* total, ssize_t change, bool) {
    const WithinCommit order;
    static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(change, std::memory_order_relaxed);
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device.get(), count, &bytes);
  return device;
}

EmbreeScene make_scene(RTCDevice device, bool robust) {
  EmbreeScene scene(rtcNewScene(device));
  check(device);
  rtcSetSceneFlags(scene.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

#ifdef __SANITIZE_THREAD__
WithinCommit::WithinCommit() { commits.load(std::memory_order_acquire); }
WithinCommit::~WithinCommit() { calls_back.fetch_add(1, std::memory_order_release); }
#else
WithinCommit::WithinCommit() {}
WithinCommit::~WithinCommit() {}
#endif

void commit(RTCDevice device, RTCScene scene) {
#ifdef __SANITIZE_THREAD__
  commits.fetch_add(1, std::memory_order_acq_rel);
#endif
  const CancelToken* const cancel = current_call().cancel;
  const auto go_on = [](void* token, double) { return !static_cast<const CancelToken*>(token)->cancelled(); };
  if (cancel != nullptr) rtcSetSceneProgressMonitorFunction(scene, go_on, const_cast<CancelToken*>(cancel));
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  stop_if_cancelled();
#ifdef __SANITIZE_THREAD__
  calls_back.load(std::memory_order_acquire);
#endif
  check(device);
}

void attach_triangles(RTCDevice device, RTCScene scene, unsigned geometry, TriangleSet& set) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           set.vertices_m.size() / 3);
  void* indices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle),
                                          set.triangles.size());
  check(device);
  std::memcpy(vertices, set.vertices_m.data(), set.vertices_m.size() * sizeof(float));
  std::memcpy(indices, set.triangles.data(), set.triangles.size() * sizeof(Triangle));
  set.vertices_m = {};
  set.triangles = {};
  rtcSetGeometryUserData(g, &set);
  rtcSetGeometryIntersectFilterFunction(g, propose_triangle);
  rtcSetGeometryOccludedFilterFunction(g, propose_occluder);
  attach(device, scene, g, geometry);
}

void attach_analytic(RTCDevice device, RTCScene scene, unsigned geometry, const AnalyticSet& set) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(set.shapes.size()));
  rtcSetGeometryUserData(g, const_cast<AnalyticSet*>(&set));
  rtcSetGeometryBoundsFunction(g, bound_analytic, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect_analytic);
  rtcSetGeometryOccludedFunction(g, occlude_analytic);
  attach(device, scene, g, geometry);
}

void attach_field(RTCDevice device, RTCScene scene, unsigned geometry, const PlacedField& field) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, field.field->blocks());
  rtcSetGeometryUserData(g, const_cast<PlacedField*>(&field));
  rtcSetGeometryBoundsFunction(g, bound_field, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect_field);
  rtcSetGeometryOccludedFunction(g, occlude_field);
  attach(device, scene, g, geometry);
}

void attach_instance(RTCDevice device, RTCScene scene, unsigned geometry, RTCScene what,
                     const math::Transform& scene_from_set) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(g, what);
  const Vec3 x = scene_from_set.column_x(), y = scene_from_set.column_y(), z = scene_from_set.column_z();
  const Point3 o = scene_from_set.origin_m();
  const float columns[12] = {float(x.x), float(x.y), float(x.z), float(y.x), float(y.y), float(y.z),
                             float(z.x), float(z.y), float(z.z), float(o.x), float(o.y), float(o.z)};
  rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  attach(device, scene, g, geometry);
}

}  // namespace ifov::geometry
