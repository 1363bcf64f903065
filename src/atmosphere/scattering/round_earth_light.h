#pragma once

#include <cstddef>
#include <vector>

namespace ifov::atmosphere {

class ScatteringColumn;

/// How much brighter the light is that the air about a round Earth has scattered than in a column of flat layers: its mean
/// radiance over all directions, by altitude and by the height of the Sun there, and its flux down. Ratios of two simpler
/// solutions, in shells and in flat layers (docs/theory/atmosphere_round_earth.md).
class RoundEarthLight {
 public:
  /// None: all ratios are 1.
  RoundEarthLight() = default;
  explicit RoundEarthLight(const ScatteringColumn& column);

  bool any() const { return !angle_rad_.empty(); }
  /// Of the mean radiance at a position of a sublayer (0 at its top, 1 at its bottom), where the Sun has this cosine of the
  /// zenith angle. Beyond a few degrees from the column's own the outermost hold.
  double mean_ratio(std::size_t sublayer, double position, double sun_mu) const;
  /// Of the diffuse flux down at boundaries of sublayers.
  const std::vector<double>& flux_ratio() const { return flux_ratio_; }

 private:
  double at(std::size_t angle, std::size_t boundary) const {
    return log_ratio_[boundary * angle_rad_.size() + angle];
  }
  std::vector<double> angle_rad_;  ///< of the Sun from the zenith, rising, evenly spaced
  std::vector<double> log_ratio_;  ///< [boundary][angle]
  std::vector<double> flux_ratio_;
};

}  // namespace ifov::atmosphere
