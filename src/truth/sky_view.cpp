#include "truth/sky_view.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "sampling/field.h"
#include "sampling/means/replicated_mean.h"
#include "sampling/warp.h"
#include "sensor/single_views.h"
#include "truth/side_seen.h"

namespace ifov::truth {
namespace {

constexpr double kLimit = 1e-3, kConfidence = 0.95;
constexpr std::uint64_t kMostRays = 1u << 18, kSkyPoints = 0x736b7976696577ull;

/// Of the plane at a ray's origin whose normal it is.
void sky_view_of(const geometry::World& world, const math::Ray& plane, std::uint64_t key, float* values) {
  const sampling::TangentFrame frame(plane.direction);
  std::vector<math::Ray> rays;
  std::vector<std::uint8_t> blocked;
  const auto sky = [&](std::span<const sampling::Point2> points, std::span<double> free) {
    rays.clear(), blocked.assign(points.size(), 0);
    for (const sampling::Point2& u : points)
      rays.push_back(plane.onward(plane.origin_m, frame.to_world(sampling::cosine_hemisphere(u))));
    world.occluded(rays, blocked);
    for (std::size_t k = 0; k < points.size(); ++k)
      free[k] = blocked[k] == 0 && rays[k].direction.z > 0.0 ? 1.0 : 0.0;
  };
  const sampling::ReplicatedMean mean = sampling::replicated_mean(key, kConfidence, kLimit, kMostRays, sky);
  values[0] = static_cast<float>(mean.mean);
  values[1] = static_cast<float>(mean.half_width);
}

void collect_sky_view(const MiddleRays& rays, std::span<float> values) {
  std::fill(values.begin(), values.end(), std::numeric_limits<float>::quiet_NaN());
  const bool own = dynamic_cast<const sensor::HemisphereView*>(rays.camera) != nullptr;
  for (std::size_t k = 0; k < rays.rays.size(); ++k) {
    const geometry::SurfacePoint& hit = rays.hits[k];
    if (!own && !hit.hit()) continue;
    math::Ray plane = rays.rays[k];
    if (!own) {
      const math::Vec3 normal = hit.geometric_normal.as_vector(), seen = hit.front ? normal : -normal;
      plane = plane.onward(hit.position_m + hit.offset_m * seen, normal_seen(hit, rays.surfaces[k]));
    }
    sky_view_of(*rays.scene.world, plane,
                sampling::hash(kSkyPoints, static_cast<std::int64_t>(rays.points[k].x_px),
                               static_cast<std::int64_t>(rays.points[k].y_px)),
                &values[2 * k]);
  }
}

}  // namespace

constinit const Collector kSkyView{"sky_view", 2, collect_sky_view};

}  // namespace ifov::truth
