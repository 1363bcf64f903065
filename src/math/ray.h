#pragma once

#include <limits>

#include "math/vec3.h"

namespace ifov::math {

/// A ray in scene coordinates (ENU metres about the scene's origin). `direction` has length 1. It meets the scene as
/// that is at one instant: light takes no time here.
struct Ray {
  Point3 origin_m;
  Vec3 direction;
  double t_min_m = 0.0;
  double t_max_m = std::numeric_limits<double>::infinity();
  double time_s = 0.0;  ///< after the document's instant

  /// Another ray of the same time: what goes on where this one met something.
  Ray onward(Point3 from_m, Vec3 towards) const {
    return {.origin_m = from_m, .direction = towards, .time_s = time_s};
  }
};

}  // namespace ifov::math
