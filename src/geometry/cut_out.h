#pragma once

#include "math/vec3.h"

namespace ifov::geometry {

/// Where a surface is not there: a ray that meets it in a hole goes straight on, as if nothing had been in its way. Asked from
/// many threads; the answer depends on the place alone.
class CutOut {
 public:
  virtual ~CutOut() = default;
  /// `position_m` in the scene's frame, `u` and `v` as of SurfacePoint.
  virtual bool is_open(math::Point3 position_m, double u, double v) const = 0;
};

}  // namespace ifov::geometry
