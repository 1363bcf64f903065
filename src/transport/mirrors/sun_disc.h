#pragma once

#include <vector>

#include "math/vec3.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

/// Three points near the rim of the Sun's disc about a direction, or that itself for a point Sun. They tell "all of it
/// is seen" from "none" and "some"; where they are wrong labels are, which costs rays and nothing else.
std::vector<math::Vec3> fixed_disc_points(math::Vec3 towards_sun, double half_angle_rad);

/// Radiance of the Sun's disc in a direction over its irradiance, 1/sr; 0 beside it, below the horizon, and for a point Sun or none.
double sun_disc_radiance(const scene::Scene& scene, math::Vec3 direction);

}  // namespace ifov::transport
