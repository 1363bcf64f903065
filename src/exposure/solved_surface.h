#pragma once

#include <memory>

#include "scene/solved_temperature.h"
#include "thermal/surface_classes.h"

namespace ifov::geometry {
class World;
}

namespace ifov::exposure {

/// The temperature of points of one material: its classes (thermal/surface_classes.h) by the point's own direction, the share
/// of the sky that is free over it, and its own visibility of the Sun in the past, both asked by rays. 2 kSunPairs of these
/// go to where the Sun stood, two in each stratum of the sum over w_k, so that the sum is estimated without bias; the two
/// tell how uncertain that is.
class SolvedSurface final : public scene::SolvedTemperature {
 public:
  static constexpr int kSunPairs = 5, kSkyPairs = 2;

  /// Keeps the reference to the world. `sun_radius_rad`: of the Sun's disc.
  SolvedSurface(std::shared_ptr<const thermal::SurfaceClasses> classes, const geometry::World& world,
                double sun_radius_rad);

  scene::EstimatedTemperature at(const geometry::SurfacePoint& point, std::uint64_t draw) const override;
  double coldest_k() const override { return classes_->coldest_k(); }
  double hottest_k() const override { return classes_->hottest_k(); }

  /// What a point sees: the free share of its sky, and of the Sun's disc by sunlit row of the classes.
  struct Exposure {
    double free_sky = 1.0;
    std::vector<double> visibility;
  };
  /// With `sky_pairs` pairs of rays to the sky and `sun_rays` to each of the Sun's places.
  Exposure exposure(const geometry::SurfacePoint& point, std::uint64_t key, int sky_pairs,
                    int sun_rays) const;
  /// The same sum as at(), of all of it.
  double temperature_k(const geometry::SurfacePoint& point, const Exposure& exposure) const;

  const thermal::SurfaceClasses& classes() const { return *classes_; }

 private:
  math::Vec3 toward_sun(std::size_t row, std::uint64_t key) const;

  std::shared_ptr<const thermal::SurfaceClasses> classes_;
  const geometry::World& world_;
  double sun_radius_rad_;
};

}  // namespace ifov::exposure
