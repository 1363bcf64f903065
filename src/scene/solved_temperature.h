#pragma once

#include <cstdint>
#include <optional>

namespace ifov::geometry {
struct SurfacePoint;
}

namespace ifov::scene {

struct HeatFluxes;

/// A temperature that is estimated by chance, and its standard deviation. Light is that of `else_k` and `times` what is more than that.
struct EstimatedTemperature {
  double kelvin = 0.0, deviation_k = 0.0;
  double else_k = 0.0, times = 1.0;  ///< 1: the estimate's alone
  double else_deviation_k = 0.0;     ///< where that is estimated, too
};

/// What a surface's temperature is at a point, where it follows from what the Sun, the sky and the air did there. Called for
/// every hit, from many threads.
class SolvedTemperature {
 public:
  virtual ~SolvedTemperature() = default;

  /// As share: asked for the temperature itself, by all rays that there are, not for light.
  static constexpr double kItself = 2.0;

  /// Without bias. Depends on the point, on `share` and on `draw` alone, of which every value gives other rays into the past. `share`: what of
  /// the surface's emission its caller's light takes, about; where that is little, few rays have to do.
  virtual EstimatedTemperature at(const geometry::SurfacePoint& point, std::uint64_t draw,
                                  double share) const = 0;
  EstimatedTemperature at(const geometry::SurfacePoint& point, std::uint64_t draw) const {
    return at(point, draw, kItself);
  }

  /// What a point gains now, estimated by rays that depend on the point and on `draw` alone; nothing where that is not known.
  virtual std::optional<HeatFluxes> fluxes(const geometry::SurfacePoint& point, std::uint64_t draw) const;

  /// Between which temperatures lie; estimates of them may stray beyond by their deviations.
  virtual double coldest_k() const = 0;
  virtual double hottest_k() const = 0;
};

}  // namespace ifov::scene
