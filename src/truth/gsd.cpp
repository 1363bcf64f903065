#include "truth/gsd.h"

#include <cmath>
#include <limits>
#include <vector>

#include "sensor/camera.h"

namespace ifov::truth {
namespace {

/// From the middle of the pixel to where a ray meets the plane through `at`; not a number where it does not. What comes from no place
/// (`endless`) may meet it behind where the ray happens to start.
math::Vec3 on_plane(const math::Ray& ray, const geometry::SurfacePoint& at, bool endless) {
  const double along = math::dot(at.geometric_normal, at.position_m - ray.origin_m) /
                       math::dot(at.geometric_normal, ray.direction);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(along) || !(along > 0.0 || endless)) return {kNone, kNone, kNone};
  return ray.origin_m + along * ray.direction - at.position_m;
}

void collect_gsds(const MiddleRays& rays, std::span<float> values) {
  const std::size_t count = rays.rays.size();
  if (count == 0) return;
  const bool parallel = !rays.camera->pose(rays.points[0].y_px).position_m;
  constexpr double kSides[4][2] = {{-0.5, 0.0}, {0.5, 0.0}, {0.0, -0.5}, {0.0, 0.5}};
  std::vector<sampling::FocalPoint> points(4 * count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t side = 0; side < 4; ++side) {
      points[4 * k + side] = rays.points[k];
      points[4 * k + side].x_px += kSides[side][0];
      points[4 * k + side].y_px += kSides[side][1];
    }
  std::vector<math::Ray> sides(points.size());
  rays.camera->rays(points, sides);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const math::Ray* const pair = &sides[4 * k + 2 * axis];
      const geometry::SurfacePoint& hit = rays.hits[k];
      values[2 * k + axis] = hit.hit() ? static_cast<float>(math::length(on_plane(pair[1], hit, parallel) -
                                                                         on_plane(pair[0], hit, parallel)))
                                       : std::numeric_limits<float>::quiet_NaN();
    }
}

}  // namespace

constinit const Collector kGsd{"gsd", 2, collect_gsds};

}  // namespace ifov::truth
