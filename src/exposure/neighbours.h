#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "exposure/past_scene.h"
#include "scene/scene.h"
#include "thermal/surface_classes.h"

namespace ifov::geometry {
struct SurfacePoint;
}

namespace ifov::exposure {

class ExposedPoint;

/// What surfaces send to each other: light of the Sun and sky that they reflect, as lit or shaded as they were, and the heat of their
/// own temperature. Each is known by its class and a few rays: whether it saw the Sun at the time that is asked of and at the time that
/// warmed it, and what one ray by its cosine meets.
class Neighbours {
 public:
  /// By number of Scene::solved; null: not solved.
  using ByNumber = std::vector<std::shared_ptr<const thermal::SurfaceClasses>>;
  /// `scene`: a copy, whose own solved temperatures are not asked for.
  Neighbours(scene::Scene scene, ByNumber classes, double sun_radius_rad);

  /// By what a point of these classes is warmer now for what a ray in a direction meets, were all its view of that, than were it level
  /// ground: an estimate of one draw, in shade and by what always Sun adds to it. None where nothing is met.
  struct Change {
    double in_shade_k = 0.0, of_sun_k = 0.0;
  };
  Change change(const ExposedPoint& point, const thermal::Pose& pose, const thermal::SurfaceClasses& classes,
                math::Vec3 direction, std::uint64_t key) const;

  const ByNumber& classes() const { return classes_; }
  const scene::Scene& scene() const { return scene_; }

 private:
  /// What a surface that was met sends at a row of the series, W m-2; `depth`: of further surfaces that light and warm it.
  thermal::FromBeside sent(const geometry::SurfacePoint& met, std::size_t row, int depth,
                           std::uint64_t key) const;
  bool sees_sun(const ExposedPoint& point, std::size_t row, std::uint64_t key) const;
  /// Whether the Sun was seen at a time that warmed the surface until a row; false where none did.
  bool warmed_by_sun(const ExposedPoint& point, const thermal::Pose& pose,
                     const thermal::SurfaceClasses& classes, std::size_t row, std::uint64_t key) const;

  scene::Scene scene_;
  PastScene past_;
  ByNumber classes_;
  const thermal::SurfaceClasses* any_ = nullptr;  ///< of the same series as all
  double sun_radius_rad_;
};

}  // namespace ifov::exposure
