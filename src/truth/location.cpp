#include "truth/location.h"

#include <limits>

namespace ifov::truth {
namespace {

void collect_locations(const MiddleRays& rays, std::span<double> values) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    const geometry::SurfacePoint& hit = rays.hits[k];
    const math::Point3 p = hit.hit() ? hit.position_m : math::Point3{kNowhere, kNowhere, kNowhere};
    values[3 * k] = p.x;
    values[3 * k + 1] = p.y;
    values[3 * k + 2] = p.z;
  }
}

}  // namespace

constinit const Collector kLocation{"location", 3, collect_locations};

}  // namespace ifov::truth
