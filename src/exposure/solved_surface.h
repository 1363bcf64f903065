#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "exposure/past_scene.h"
#include "scene/solved_temperature.h"
#include "thermal/surface_classes.h"

namespace ifov::exposure {

class ExposedPoint;
class Neighbours;
struct PointRays;

/// The temperature of points of one material: its classes (thermal/surface_classes.h) by the point's own direction, the share of the sky that is free over it, and its own visibility of the Sun in
/// the past, both asked by rays. 2 kSunPairs of these go to where the Sun stood, two in each stratum of the sum over w_k, so that the sum is estimated without bias; the two tell how uncertain
/// that is. Where things came and went, rays meet what stood there at their time; those to the sky are then sent twice, now and at a time of the past by the size of s_k, and what they differ by
/// counts with s_k.
class SolvedSurface final : public scene::SolvedTemperature {
 public:
  static constexpr int kSunPairs = 5, kSkyPairs = 2;  ///< at most

  /// By what surfaces warm a point in place of level ground, if they were all it sees: in shade, and by what always Sun adds to that.
  struct Warmth {
    double in_shade_k = 0.0, of_sun_k = 0.0;
  };
  /// What an image spends on the temperature of a point that it sees: pairs of rays to the Sun at most, and the chance by which is asked what is about it. What is not asked is taken for
  /// `above` where a ray to the sky meets something, and for `below` below the horizon. Without bias whatever they are, as long as they do not depend on what rays say.
  struct Spent {
    int sun_pairs = kSunPairs;
    double chance_beside = 1.0;
    Warmth above{}, below{};
  };

  /// Keeps the references to the scene. `sun_radius_rad`: of the Sun's disc. Where things come and go, the classes have a `past_sky`.
  SolvedSurface(std::shared_ptr<const thermal::SurfaceClasses> classes, PastScene scene,
                double sun_radius_rad, std::shared_ptr<const Neighbours> neighbours = nullptr);
  /// The same at another cost in images.
  SolvedSurface spending(const Spent& spent) const;
  const Spent& spent() const { return spent_; }
  /// What comes to the one face that a point is on, or to both of a sheet; not its temperature.
  SolvedSurface exposed_on(bool two_faces) const;

  using scene::SolvedTemperature::at;
  scene::EstimatedTemperature at(const geometry::SurfacePoint& point, std::uint64_t draw,
                                 double share) const override;
  std::optional<scene::HeatFluxes> fluxes(const geometry::SurfacePoint& point,
                                          std::uint64_t draw) const override;
  double coldest_k() const override { return classes_->coldest_k(); }
  double hottest_k() const override { return classes_->hottest_k(); }

  /// What a point is exposed to: how high the wind is that it meets, the free share of its sky, and of the Sun's disc by sunlit row of the classes.
  struct Exposure {
    double height_m = 0.0;  ///< above ground
    double free_sky = 1.0;
    std::vector<double> visibility;
    std::vector<double> past_free_sky{};  ///< by row of the series, where things came and went; else empty
  };
  /// With `sky_pairs` pairs of rays to the sky and `sun_rays` to each of the Sun's places.
  Exposure exposure(const geometry::SurfacePoint& point, std::uint64_t key, int sky_pairs,
                    int sun_rays) const;
  /// How little a point's past is like that of a surface always in the Sun or never, by a look at some of the Sun's places: what the rise in the Sun is worth, times V (1 - V). And how much of it,
  /// and of the sky, is otherwise for what came or went. Kelvins.
  struct Unsettled {
    double mixed_k = 0.0, changed_k = 0.0;
  };
  Unsettled unsettled(const geometry::SurfacePoint& point) const;
  /// Outwards, from the side that was met.
  math::Vec3 normal_at(const geometry::SurfacePoint& point) const;
  /// The same sum as at(), of all of it.
  double temperature_k(const geometry::SurfacePoint& point, const Exposure& exposure) const;

  /// By how much what is about a point warms it, beyond level ground: mean of what at() takes for it over some draws, with so many surfaces further behind. 0 without neighbours.
  double beside_k(const geometry::SurfacePoint& point, const Exposure& exposure, std::uint64_t key, int draws,
                  int further = 0) const;
  /// What one ray to the sky and one below the horizon tell of what is about a point, of which `above` and `below` of an image are to be the means; nothing where the first meets nothing, or where
  /// nothing lies that way.
  struct AskedAbout {
    std::optional<Warmth> above, below;
  };
  AskedAbout asked_about(const geometry::SurfacePoint& point, std::uint64_t key) const;
  /// What the Sun was worth to a point of what it is worth where it is always seen.
  double sun_share(const geometry::SurfacePoint& point, const Exposure& exposure) const;
  /// Whether a few rays, which `key` draws, meet anything.
  bool sees_surfaces(const geometry::SurfacePoint& point, std::uint64_t key) const;
  /// The same where what hides the sky is taken to be as the ground.
  SolvedSurface without_neighbours() const { return {classes_, scene_, sun_radius_rad_}; }
  /// Null: what hides the sky is taken to be as the ground.
  const std::shared_ptr<const Neighbours>& neighbours() const { return neighbours_; }
  const thermal::SurfaceClasses& classes() const { return *classes_; }
  const std::shared_ptr<const thermal::SurfaceClasses>& shared_classes() const { return classes_; }
  const PastScene& scene() const { return scene_; }
  double sun_radius_rad() const { return sun_radius_rad_; }

 private:
  scene::EstimatedTemperature estimate(const geometry::SurfacePoint& point, std::uint64_t key, double share,
                                       const Spent& spent) const;
  /// What is met now, and what is sky; `met` stays empty without neighbours.
  void look(const ExposedPoint& exposed, std::span<const math::Vec3> directions,
            std::vector<geometry::SurfacePoint>& met, std::span<std::uint8_t> is_free) const;
  struct PastRay {
    math::Vec3 direction;
    double time_s = 0.0;
  };
  PastRay toward_sun(std::size_t row, std::uint64_t key) const;
  /// What the sky was to a point at other times than now, beyond what it is: an estimate by the same directions, and the pairs' variance of both together. `is_free`: which are now; `of_sky_k`:
  /// what all of them are worth.
  struct PastSky {
    /// Without the Sun, and by what it changes with half of u; where the sky was freer than now, twice that.
    double in_shade_k = 0.0, of_sun_k = 0.0;
    double variance_k2 = 0.0;
  };
  PastSky past_sky(const ExposedPoint& exposed, const thermal::Pose& pose, std::uint64_t key,
                   std::span<const math::Vec3> directions, std::span<const std::uint8_t> is_free,
                   double of_sky_k) const;
  std::vector<double> past_free_sky(const ExposedPoint& exposed,
                                    std::span<const math::Vec3> directions) const;

  /// By what the scene's surfaces warm a point in place of level ground, in shade and by what always Sun adds: by ray to the sky, 0 where that is free, then of a pair to below the horizon.
  struct Beside {
    std::array<double, 2 * kSkyPairs + 2> in_shade_k{}, of_sun_k{};
    double kelvin(std::size_t ray, double sun_share) const {
      return in_shade_k[ray] + sun_share * of_sun_k[ray];
    }
    /// Of all, to second order, by what a point is warmer for it.
    double warms_k(const thermal::SurfaceClasses& classes, const thermal::SurfaceClasses::Corners& at,
                   double sun_share) const;
  };
  Beside beside(const ExposedPoint& exposed, const thermal::Pose& pose,
                const thermal::SurfaceClasses::Corners& at, std::uint64_t key,
                std::span<const math::Vec3> directions, std::span<const geometry::SurfacePoint> met,
                const PointRays& rays, const Spent& spent) const;
  /// What is taken for that where it is not asked: `meets` tells which rays to the sky meet something.
  Beside guessed(const ExposedPoint& exposed, std::span<const std::uint8_t> meets, const Spent& spent) const;

  std::shared_ptr<const thermal::SurfaceClasses> classes_;
  PastScene scene_;
  std::shared_ptr<const Neighbours> neighbours_;
  double sun_radius_rad_;
  Spent spent_;
  bool two_faces_;
  std::vector<std::size_t> changed_rows_;  ///< of the series, about which something is not as it is now
};

}  // namespace ifov::exposure
