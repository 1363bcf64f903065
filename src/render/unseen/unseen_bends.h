#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/unseen/shining_targets.h"

namespace ifov::math {
struct Ray;
}
namespace ifov::sampling {
struct RayCounts;
struct TileResult;
}  // namespace ifov::sampling
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;

/// Light of what outshines the scene that boundaries bend, or mirrors by way of which it is not sought throw, on surfaces: scattered
/// paths find it by chance. Rays from what a pixel sees, by such ways, towards what shines as if that were thirty degrees
/// wide tell how much it may be, where too few of the pixel's paths have found any of it. That marks pixels; it
/// never enters a radiance.
class UnseenBends {
 public:
  /// Null where there are no such boundaries and mirrors, or nothing outshines the scene. Keeps references.
  static std::unique_ptr<const UnseenBends> find(const transport::SpectralScene& scene,
                                                 const sensor::Camera& camera, std::uint64_t seed);

  /// Light that so many of a pixel's paths have found is known as well as the pixel's error says.
  static constexpr double kKnown = 30.0;
  /// As UnseenLight's.
  static constexpr double kCaution = 2.0, kNegligible = 0.1;

  /// Widens the half-widths of a finished tile that has channels alone; pixels that become wider than was asked for get
  /// Reason::unseen_light. Adds the rays. Nothing without a tolerance.
  void settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const;

 private:
  UnseenBends(const transport::SpectralScene& scene, const sensor::Camera& camera, std::uint64_t seed);
  class Chain;  // of mirrors and boundaries that a ray meets
  class Aims;   // directions towards what throws light
  struct Told;  // of a tile, by pixel and channel
  void send(const math::Ray& seen, std::uint64_t name, std::size_t pixel, ShiningTargets& targets, Told& told,
            sampling::RayCounts& counts) const;
  /// What leaves a chain, times its weight, may meet of what shines; by channel into `told`.
  void add_exit(const math::Ray& exit, double weight, std::size_t pixel, ShiningTargets& targets, Told& told,
                sampling::RayCounts& counts) const;
  bool is_free(const math::Ray& from, const ShiningTarget& target, sampling::RayCounts& counts) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::uint64_t seed_;
  transport::ShiningParts parts_;
  MovingParts moving_;
  std::vector<ShiningTarget> targets_;  // of what stands still
  std::vector<geometry::SurfaceSurvey::Ball> throwers_;
};

}  // namespace ifov::render
