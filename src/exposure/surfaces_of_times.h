#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "exposure/neighbours.h"
#include "exposure/past_scene.h"
#include "scene/temperature_scope.h"
#include "thermal/times/classes_of_times.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::exposure {

class PastSuns;
struct PointRays;

/// The temperatures of points at several times of one scene in which nothing came or went. Rays to where the Sun stood are asked once for all: two to each bin of the past
/// (thermal/times/classes_of_times.h), at a time that is drawn within it (PastSuns). Where both see the same of the Sun the bin's whole w_k counts by it; where they do not, each tells how far w_k
/// at its time is off the bin's mean,
///
///   sum of w_k V over the bin = (V_1 + V_2) / 2 W + (f_1 - f_2) (V_1 - V_2) / 2,   variance (V_1 - V_2)^2 ((f_1^2 + f_2^2) - W^2) / 4,
///
/// with W the sum of w_k and f its density over the ray's, both without bias. The sky, and how high a point stands, are the same at all times. What a ray meets that is not sky was another at
/// each: times that follow each other share a row of the past at which that is asked for.
class SurfacesOfTimes final : public scene::TemperaturesOfTimes {
 public:
  using ByTime = std::vector<std::shared_ptr<const thermal::SurfaceClasses>>;
  /// `by_number`: as Scene::solved, those that are solved. Keeps the references to the scene.
  SurfacesOfTimes(const std::map<std::size_t, ByTime>& by_number, PastScene scene, double sun_radius_rad,
                  std::vector<std::shared_ptr<const Neighbours>> neighbours = {});
  ~SurfacesOfTimes() override;
  /// Of scenes of one world, by time; null where their pasts have no rows in common, something came or went, or nothing is solved.
  static std::unique_ptr<const SurfacesOfTimes> of(std::span<const scene::Scene* const> by_time);

  std::size_t times() const override { return times_; }
  void at(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t draw, double share,
          std::span<scene::EstimatedTemperature> by_time) const override;
  /// Rays to the Sun that a point takes.
  std::size_t sun_rays(std::size_t number) const { return 2 * classes_.at(number)->bins(); }

 private:
  std::vector<std::unique_ptr<const thermal::ClassesOfTimes>> classes_;  ///< null: not solved
  std::vector<std::unique_ptr<const PastSuns>> suns_;                    ///< of each of them
  /// Which times share rows, in their order; by number of Scene::solved what they ask. Empty without neighbours.
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::vector<std::vector<Neighbours::Time>>> asked_;
  std::vector<std::shared_ptr<const Neighbours>> neighbours_;  ///< by time
  PastScene scene_;
  std::size_t times_;

  struct Beside;
  void ask_beside(std::size_t number, const ExposedPoint& exposed, const thermal::Pose& pose,
                  std::uint64_t key, std::span<const math::Vec3> directions,
                  std::span<const geometry::SurfacePoint> met, const PointRays& rays, Beside& beside) const;
  void estimate(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t key, double share,
                std::span<scene::EstimatedTemperature> by_time) const;
};

}  // namespace ifov::exposure
