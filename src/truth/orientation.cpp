#include "truth/orientation.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "geodesy/sun_position.h"
#include "truth/side_seen.h"

namespace ifov::truth {
namespace {

constexpr float kNoSurface = std::numeric_limits<float>::quiet_NaN();

void collect_normals(const MiddleRays& rays, std::span<float> values) {
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    const bool known = rays.hits[k].hit();
    const math::Vec3 n = known ? normal_seen(rays.hits[k], rays.surfaces[k]) : math::Vec3{};
    values[3 * k] = known ? static_cast<float>(n.x) : kNoSurface;
    values[3 * k + 1] = known ? static_cast<float>(n.y) : kNoSurface;
    values[3 * k + 2] = known ? static_cast<float>(n.z) : kNoSurface;
  }
}

void collect_slopes(const MiddleRays& rays, std::span<float> values) {
  constexpr double kDegrees = 180.0 / std::numbers::pi, kLevel = 1e-6;
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    values[2 * k] = values[2 * k + 1] = kNoSurface;
    if (!rays.hits[k].hit()) continue;
    const math::Vec3 n = normal_seen(rays.hits[k], rays.surfaces[k]);
    const double level = std::hypot(n.x, n.y);
    values[2 * k] = static_cast<float>(std::atan2(level, n.z) * kDegrees);
    if (level >= kLevel) values[2 * k + 1] = static_cast<float>(geodesy::compass_deg(std::atan2(n.x, n.y)));
  }
}

}  // namespace

constinit const Collector kNormal{"normal", 3, collect_normals};
constinit const Collector kSlope{"slope", 2, collect_slopes};

}  // namespace ifov::truth
