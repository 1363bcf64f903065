#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace ifov::geometry {
class MovingWorld;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class ShiningParts;
}

namespace ifov::render {

/// What moves of some surface assignments: of each mover all of one of them, in a ball of its carrier's frame.
class MovingParts {
 public:
  /// Keeps references.
  MovingParts(const scene::Scene& scene, const sensor::Camera& camera, const std::vector<bool>& wanted);
  /// Of those that shine; while a camera flies each ray is asked for its own instant alone (lattice_times_s).
  MovingParts(const scene::Scene& scene, const sensor::Camera& camera,
              const transport::ShiningParts& shining);

  struct Part {
    std::size_t mover = 0;
    std::uint32_t assignment = 0;
    math::Point3 centre_m;  ///< in the carrier's frame
    double radius_m = 0.0, area_m2 = 0.0;
    /// Of the ball's disc that it fills as seen from anywhere, about: a quarter of the area of what is closed.
    double fill() const;
  };
  bool any() const { return !parts_.empty(); }

  /// Where a part is at one of several instants of an exposure.
  struct Place {
    const Part* part = nullptr;
    math::Point3 centre_m;
    double time_s = 0.0, way_m = 0.0;  ///< the latter from there until half way to the next instant
    double of_time = 1.0;              ///< share of the exposure
  };
  /// While a ray of some time is exposed: asked for again where that differs from the last.
  class Places {
   public:
    explicit Places(const MovingParts& of) : of_(of) {}
    std::span<const Place> at(double time_s);

   private:
    const MovingParts& of_;
    bool known_ = false;
    double time_s_ = 0.0;
    std::vector<Place> places_;
  };

 private:
  std::vector<Place> places(double time_s) const;

  const geometry::MovingWorld* world_;  // null: nothing moves
  double exposure_s_;
  std::vector<Part> parts_;
};

}  // namespace ifov::render
