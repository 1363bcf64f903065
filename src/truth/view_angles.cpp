#include "truth/view_angles.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "geodesy/sun_position.h"

namespace ifov::truth {
namespace {

void collect_view_angles(const MiddleRays& rays, std::span<float> values) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    const math::Vec3 to_sensor = -rays.rays[k].direction;
    const bool known = rays.hits[k].hit();
    const double zenith = std::atan2(std::hypot(to_sensor.x, to_sensor.y), to_sensor.z) * kDegrees,
                 azimuth = geodesy::compass_deg(std::atan2(to_sensor.x, to_sensor.y));
    values[2 * k] = known ? static_cast<float>(zenith) : kUnknown;
    values[2 * k + 1] = known ? static_cast<float>(azimuth) : kUnknown;
  }
}

}  // namespace

constinit const Collector kViewAngles{"view_angles", 2, collect_view_angles};

}  // namespace ifov::truth
