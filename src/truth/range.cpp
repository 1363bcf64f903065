#include "truth/range.h"

#include <limits>

#include "sensor/camera.h"

namespace ifov::truth {
namespace {

void collect_ranges(const MiddleRays& rays, std::span<double> values) {
  for (std::size_t k = 0; k < rays.hits.size(); ++k)
    values[k] = rays.hits[k].hit() ? rays.hits[k].distance_m : std::numeric_limits<double>::quiet_NaN();
  if (rays.hits.empty() || rays.camera->pose(rays.points[0].y_px).position_m) return;
  for (double& value : values) value = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

constinit const Collector kRange{"range", 1, collect_ranges};

}  // namespace ifov::truth
