#pragma once

#include <limits>

#include "math/vec3.h"

namespace ifov::math {

/// A ray in scene coordinates (ENU metres about the scene's origin). `direction` has length 1.
struct Ray {
  Point3 origin_m;
  Vec3 direction;
  double t_min_m = 0.0;
  double t_max_m = std::numeric_limits<double>::infinity();
};

}  // namespace ifov::math
