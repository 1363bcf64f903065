#pragma once

#include <cstddef>
#include <vector>

namespace ifov::atmosphere {

class ScatteringColumn;

/// How much brighter the light is that the air about a round Earth has scattered than in a column of flat layers: its mean
/// radiance over all directions, and where it comes from, by altitude and by the height of the Sun there, and its flux down. Ratios of two simpler
/// solutions, in shells and in flat layers (docs/theory/atmosphere_round_earth.md).
class RoundEarthLight {
 public:
  /// None: all ratios are 1.
  RoundEarthLight() = default;
  explicit RoundEarthLight(const ScatteringColumn& column);

  bool any() const { return !angle_rad_.empty(); }
  /// At a position of a sublayer (0 at its top, 1 at its bottom), where the Sun has this cosine of the
  /// zenith angle. Beyond a few degrees from the column's own the outermost hold.
  struct Change {
    double ratio = 1.0;  ///< of the mean radiance
    /// Where the light comes from, besides: what the mean radiance times the cosine of its direction with the vertical, and with
    /// the horizontal towards the Sun, has more than `ratio` times that of flat layers. Of sunlight of irradiance 1 across the beam.
    double up = 0.0, sunward = 0.0;
  };
  Change change(std::size_t sublayer, double position, double sun_mu) const;
  /// Of the diffuse flux down at boundaries of sublayers.
  const std::vector<double>& flux_ratio() const { return flux_ratio_; }

 private:
  std::vector<double> angle_rad_;     ///< of the Sun from the zenith, rising
  std::vector<double> log_ratio_;     ///< [boundary][angle]
  std::vector<double> up_, sunward_;  ///< [boundary][angle]: changes over the mean radiance
  std::vector<double> log_flat_;      ///< [boundary]: of the mean radiance in flat layers
  std::vector<double> flux_ratio_;
};

}  // namespace ifov::atmosphere
