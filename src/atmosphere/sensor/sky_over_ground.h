#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::atmosphere {

class SensorAtmosphere;

/// The light of Sun and sky that falls on a ground which reflects by direction, and what that makes of it, by node.
class SkyOverGround {
 public:
  /// Keeps a reference; the atmosphere's tables are SensorAtmosphere::directional(). `emitted`: radiance of the ground's own, by
  /// node.
  SkyOverGround(const SensorAtmosphere& air, std::span<const double> emitted);

  /// I alone, or I, Q and U where the tables have them.
  std::size_t components() const { return components_; }
  /// Radiance that leaves the ground towards a direction (mu > 0; azimuth of propagation, counterclockwise), about the meridional
  /// frame: of the Sun, and of the sky. [component][node].
  struct Radiance {
    std::vector<double> sun, sky;
  };
  Radiance towards(double mu, double azimuth_rad) const;
  /// The second alone, added to `light`.
  void add_sky(double mu, double azimuth_rad, std::span<double> light) const;

 private:
  struct Direction {
    double mu, azimuth_rad;
  };
  const SensorAtmosphere& air_;
  std::size_t components_;
  std::vector<Direction> directions_;  ///< that light comes from, on both sides of the Sun's plane
  std::vector<float> light_;           ///< [direction][component][node], times cosine and solid angle
};

}  // namespace ifov::atmosphere
