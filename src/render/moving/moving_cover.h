#pragma once

#include <memory>

#include "geometry/surface_point.h"
#include "math/ray.h"
#include "sampling/field.h"

namespace ifov::geometry {
class MovingWorld;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Where what moves may be seen while a point of the focal plane is exposed. There time is one more dimension of the paths; what is
/// seen elsewhere is the same at all times of the exposure.
class MovingCover {
 public:
  /// Null where nothing moves, or light falls on a point at one instant that its place tells (a scanner).
  static std::unique_ptr<const MovingCover> find(const scene::Scene& scene, const sensor::Camera& camera);

  /// When a path's light falls on its point, about the middle of the exposure of that.
  double time_s(const sampling::PathRequest& request) const;

  /// Whether something that moves may lie on the ray through a point while that is exposed. `met`: what it meets at its own time.
  bool covers(const sampling::FocalPoint& point, const math::Ray& ray,
              const geometry::SurfacePoint& met) const;
  /// The same of rays within `spread_rad` about one that goes on from what stands still.
  bool shades(const sampling::FocalPoint& point, const math::Ray& seen, const math::Ray& towards,
              double spread_rad) const;

 private:
  MovingCover(const geometry::MovingWorld& world, double exposure_s, double beyond_s)
      : world_(world), exposure_s_(exposure_s), beyond_s_(beyond_s) {}

  const geometry::MovingWorld& world_;
  double exposure_s_;
  double beyond_s_;  ///< before and after: a point on the border of two rows belongs to both
};

}  // namespace ifov::render
