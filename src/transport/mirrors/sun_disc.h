#pragma once

#include <vector>

#include "math/vec3.h"

namespace ifov::transport {

/// Three points near the rim of the Sun's disc about a direction, or that itself for a point Sun. They tell "all of it
/// is seen" from "none" and "some"; where they are wrong labels are, which costs rays and nothing else.
std::vector<math::Vec3> fixed_disc_points(math::Vec3 towards_sun, double half_angle_rad);

}  // namespace ifov::transport
