#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "geometry/world.h"
#include "geometry/world/primitive_sets.h"
#include "geometry/world/ray_packet.h"
#include "math/transform.h"

namespace ifov::geometry {

struct ReleaseDevice {
  void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
};
struct ReleaseScene {
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Pinned to AVX2, so that machines with wider vectors give the same bytes. `threads` (0: all) build. What
/// Embree allocates is added to `bytes`, which must outlive the device.
EmbreeDevice make_device(int threads, std::atomic<std::int64_t>& bytes);

/// Of medium build quality; `robust`: watertight where triangles share vertices, at a tenth of the speed.
/// Geometry is attached, then committed; errors of Embree are SystemError.
EmbreeScene make_scene(RTCDevice device, bool robust);
void commit(RTCDevice device, RTCScene scene);
/// What the builder calls back while it commits holds one of these: the thread sanitizer cannot see that it comes after
/// what led to commit() and before what follows.
class WithinCommit {
 public:
  WithinCommit();
  ~WithinCommit();
};

/// A box in Embree's floats, widened by `padding_m` against their rounding; empty where low is above high.
RTCBounds padded(const World::Bounds& box, double padding_m);

/// Commits a geometry and hands it over to the scene.
void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, unsigned number);

/// The sets must outlive the scene; what a set holds for Embree alone is given away here.
void attach_triangles(RTCDevice device, RTCScene scene, unsigned geometry, TriangleSet& set);
void attach_analytic(RTCDevice device, RTCScene scene, unsigned geometry, const AnalyticSet& set);
void attach_field(RTCDevice device, RTCScene scene, unsigned geometry, const PlacedField& field);
void attach_instance(RTCDevice device, RTCScene scene, unsigned geometry, RTCScene what,
                     const math::Transform& scene_from_set);

}  // namespace ifov::geometry
