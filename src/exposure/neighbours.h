#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
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
  static constexpr int kDepth = 2;
  /// Surfaces behind the one that is met, which light and warm it; what is beyond them is level ground.
  struct Behind {
    int depth = kDepth;
    double chance = 1.0;  ///< by which each of the two is asked; what it says counts by the inverse
    double ground_m =
        std::numeric_limits<double>::quiet_NaN();  ///< below the point: taken for that of what is near
  };
  /// What stands in a direction that leaves the surface now.
  geometry::SurfacePoint met(const ExposedPoint& point, math::Vec3 direction) const;
  /// The same of several; nothing is met where a direction does not leave.
  void met(const ExposedPoint& point, std::span<const math::Vec3> directions,
           std::vector<geometry::SurfacePoint>& met) const;
  /// `at`: of the point's pose; `met`: in the direction, a hit.
  Change change(const ExposedPoint& point, const thermal::SurfaceClasses& classes,
                const thermal::SurfaceClasses::Corners& at, math::Vec3 direction,
                const geometry::SurfacePoint& met, std::uint64_t key, Behind behind) const;
  /// The same of whatever is met.
  Change change(const ExposedPoint& point, const thermal::SurfaceClasses& classes,
                const thermal::SurfaceClasses::Corners& at, math::Vec3 direction, std::uint64_t key,
                Behind behind) const;

  /// The same at several times of one scene, in which nothing came or went, by one row of the past for all. `by_time`: one material's classes, with
  /// the neighbours of each time.
  struct Time {
    const thermal::SurfaceClasses* classes = nullptr;
    const Neighbours* neighbours = nullptr;
  };
  static void changes(std::span<const Time> by_time, const thermal::Pose& pose,
                      const geometry::SurfacePoint& met, std::uint64_t key, Behind behind,
                      std::span<Change> changes);

  /// What a surface that was met sends at a row of the series, W m-2.
  thermal::FromBeside sent(const geometry::SurfacePoint& met, std::size_t row, Behind behind,
                           std::uint64_t key) const;
  /// Whether a point saw a place of the Sun's disc about a row's time.
  bool sees_sun(const ExposedPoint& point, std::size_t row, std::uint64_t key) const;

  const ByNumber& classes() const { return classes_; }
  const scene::Scene& scene() const { return scene_; }

 private:
  /// By one direction; of both faces of a sheet together.
  bool sees_sky(const ExposedPoint& point, std::uint64_t key) const;
  /// A row at which the Sun warmed the surface until another.
  std::size_t warming_row(const thermal::Pose& pose, const thermal::SurfaceClasses& classes,
                          const thermal::SurfaceClasses::Corners& at, std::size_t row,
                          std::uint64_t key) const;
  thermal::Pose pose_of(const ExposedPoint& point, const geometry::SurfacePoint& met, double ground_m) const;

  scene::Scene scene_;
  PastScene past_;
  ByNumber classes_;
  const thermal::SurfaceClasses* any_ = nullptr;  ///< of the same series as all
  double sun_radius_rad_;
};

}  // namespace ifov::exposure
