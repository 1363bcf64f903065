#include "transport/mirrors/sun_disc.h"

#include <cmath>
#include <numbers>

#include "math/frame.h"
#include "sampling/warp.h"
#include "scene/scene.h"

namespace ifov::transport {

std::vector<math::Vec3> fixed_disc_points(math::Vec3 towards_sun, double half_angle_rad) {
  if (half_angle_rad <= 0.0) return {towards_sun};
  constexpr double kRim = 0.97;
  const sampling::TangentFrame frame(towards_sun);
  const double sine = kRim * std::sin(half_angle_rad);
  std::vector<math::Vec3> points;
  for (int k = 0; k < 3; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / 3.0;
    points.push_back(math::normalized(
        frame.to_world({sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1.0 - sine * sine)})));
  }
  return points;
}

double sun_disc_radiance(const scene::Scene& scene, math::Vec3 direction) {
  const auto& disc = scene.sun;
  if (!disc || !(disc->half_angle_rad > 0.0) || !(direction.z > 0.0)) return 0.0;
  const double sine = std::sin(disc->half_angle_rad);
  if (!(math::length(math::cross(direction, disc->direction)) < sine) ||
      !(math::dot(direction, disc->direction) > 0.0))
    return 0.0;
  return 1.0 / (std::numbers::pi * sine * sine);
}

}  // namespace ifov::transport
