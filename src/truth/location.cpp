#include "truth/location.h"

#include <limits>
#include <vector>

#include "sensor/camera.h"

namespace ifov::truth {
namespace {

void put_places(std::span<const geometry::SurfacePoint> hits, std::span<double> values) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const geometry::SurfacePoint& hit = hits[k];
    const math::Point3 p = hit.hit() ? hit.position_m : math::Point3{kNowhere, kNowhere, kNowhere};
    values[3 * k] = p.x;
    values[3 * k + 1] = p.y;
    values[3 * k + 2] = p.z;
  }
}

void collect_true_locations(const MiddleRays& rays, std::span<double> values) {
  put_places(rays.hits, values);
}

void collect_locations(const MiddleRays& rays, std::span<double> values) {
  if (rays.camera == nullptr || &rays.camera->reported() == rays.camera) {
    put_places(rays.hits, values);
    return;
  }
  std::vector<math::Ray> reported(rays.points.size());
  std::vector<geometry::SurfacePoint> hits(rays.points.size());
  rays.camera->reported().rays(rays.points, reported);
  rays.scene.world->intersect(reported, hits);
  put_places(hits, values);
}

}  // namespace

constinit const Collector kLocation{"location", 3, collect_locations};
constinit const Collector kTrueLocation{"true_location", 3, collect_true_locations};

}  // namespace ifov::truth
