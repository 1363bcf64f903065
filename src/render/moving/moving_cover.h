#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/motion/time_interval.h"
#include "geometry/surface_point.h"
#include "math/ray.h"
#include "sampling/field.h"

namespace ifov::geometry {
class MovingWorld;
class World;
}  // namespace ifov::geometry
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Where what moves may be seen while a point of the focal plane is exposed; elsewhere that shows the same at all times.
class MovingCover {
 public:
  /// Null where nothing moves, where the camera does (FlownExposure), or light falls on a point at one instant that its place tells (a scanner).
  static std::unique_ptr<MovingCover> find(const scene::Scene& scene, const sensor::Camera& camera);

  /// When paths through a point begin, about the middle of its exposure: times at which something may be met, on the ray or on the way to the
  /// Sun from where that ends, have a path of their own, since few would meet what passes fast.
  struct Times {
    double share = 0.0;  ///< of the exposure at which something may be met; 0 or 1: there is one path
    double met_s = 0.0, else_s = 0.0;
  };
  /// `ray` through the request's point in the middle of the exposure; `first`: what it meets of what stands still; `ways`: those beyond
  /// mirrors and panes, and what the last of them meets, `first` where there is none.
  Times times(const sampling::PathRequest& request, const math::Ray& ray, const geometry::SurfacePoint& first,
              std::span<const math::Ray> ways, const geometry::SurfacePoint& last);
  /// The same of other times at which something may be met, of those from and until: which of them, on one scale with these. Sorts `met`.
  static Times drawn(std::vector<geometry::TimeInterval>& met, double from_s, double to_s,
                     const sampling::PathRequest& request);
  const geometry::World& still() const;
  void meet_still(std::span<const math::Ray> rays, std::span<geometry::SurfacePoint> hits) const;
  /// Whether something that moves may lie on the ray through a point while that is exposed. `met`: what it meets at its own time.
  bool covers(const sampling::FocalPoint& point, const math::Ray& ray,
              const geometry::SurfacePoint& met) const;
  /// The same of rays about one that goes on from what stands still.
  bool shades(const sampling::FocalPoint& point, const math::Ray& seen, const math::Ray& towards,
              double spread_rad) const;

 private:
  MovingCover(const scene::Scene& scene, double exposure_s, double beyond_s);

  const scene::Scene& scene_;
  const geometry::MovingWorld& world_;
  double exposure_s_, beyond_s_;  ///< the latter before and after: the border of two rows belongs to both
};

}  // namespace ifov::render
