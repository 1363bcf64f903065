#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/world/surface_survey.h"
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

/// Light of what outshines the scene by way of lobes so narrow that they throw it rarely (materials::throws_rarely): highlights
/// that are smaller than what paths meet in a pixel, and what such lobes throw on other surfaces. Rays on a lattice of each
/// pixel, and rays from the surfaces that they meet towards what throws light, tell how much it may be: by the same lobe, widened
/// as far as it takes for these rays to find it (Bsdf::widened_lobe). That marks pixels; it never enters a radiance.
class UnseenLobes {
 public:
  /// Null where there are no such lobes, or nothing outshines the scene. Keeps references.
  static std::unique_ptr<const UnseenLobes> find(const transport::SpectralScene& scene,
                                                 const sensor::Camera& camera, std::uint64_t seed);

  /// A highlight that fills more of a pixel is met by paths.
  static constexpr double kMet_px2 = 0.5;
  /// Light that so many of a pixel's paths have found is known as well as the pixel's error says.
  static constexpr double kKnown = 30.0;
  /// As UnseenLight's: times what may be there, in the pixel or in the mean of its neighbourhood in the tile; less than a
  /// share of what was asked for is left alone.
  static constexpr double kCaution = 2.0, kNegligible = 0.1;

  /// Widens the half-widths of a finished tile that has channels alone; pixels that become wider than was asked for get
  /// Reason::unseen_light. Adds the rays. Nothing without a tolerance.
  void settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const;

 private:
  UnseenLobes(const transport::SpectralScene& scene, const sensor::Camera& camera, std::uint64_t seed);
  struct Met;   // a surface that a ray met
  struct Rays;  // of the lattice, on their way
  struct Told;  // of a tile, by pixel and channel
  struct Grid;  // the lattice of a tile
  Met met(const math::Ray& ray, const geometry::SurfacePoint& hit) const;
  /// What the rays meet, by place on the lattice; leaves those that go on by mirrors and narrow lobes.
  std::vector<Met> follow(Rays& rays, const std::vector<Met>* before, std::size_t places,
                          sampling::RayCounts& counts) const;
  void add_highlights(const std::vector<Met>& level, const Grid& grid, ShiningTargets& targets, Told& told,
                      sampling::RayCounts& counts) const;
  void add_thrown(const std::vector<Met>& level, std::uint64_t number, const Grid& grid,
                  ShiningTargets& targets, Told& told, sampling::RayCounts& counts) const;
  /// Radiance that narrow lobes send back along the ray, over the part's: of lobes that lean by `slope` at least.
  double shown(const Met& from, const ShiningTarget& target, double slope) const;
  bool is_free(const Met& from, const ShiningTarget& target, sampling::RayCounts& counts) const;
  math::Point3 at_home(math::Point3 at) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::uint64_t seed_;
  transport::ShiningParts parts_;
  MovingParts moving_;
  std::vector<ShiningTarget> targets_;  // of what stands still
  std::vector<geometry::SurfaceSurvey::Ball> throwers_;
  double shift_x_, shift_y_;  // of the lattice, px
};

}  // namespace ifov::render
