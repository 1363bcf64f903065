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
  explicit RoundEarthLight(const ScatteringColumn& column);

  /// At a position of a sublayer (0 at its top, 1 at its bottom), where the Sun has this cosine of the
  /// zenith angle. Beyond a few degrees from the column's own the outermost hold.
  struct Change {
    double ratio = 1.0;  ///< of the mean radiance
    /// Where the light comes from, besides: what the mean radiance times the cosine of its direction with the vertical, and with
    /// the horizontal towards the Sun, has more than `ratio` times that of flat layers. Of sunlight of irradiance 1 across the beam.
    double up = 0.0, sunward = 0.0;
  };
  Change change(std::size_t sublayer, double position, double sun_mu) const;
  /// Suns of places that are much brighter than the column's own, rising: at dusk light comes from their side, and over its
  /// directions it is spread as columns of their own have it. None elsewhere. They are lower than 1 degree.
  const std::vector<double>& brighter_suns_rad() const { return brighter_rad_; }
  /// Mean radiance of flat layers under the column's own Sun over that under one of these, at boundaries of sublayers.
  const std::vector<double>& own_over(std::size_t brighter) const { return own_over_[brighter]; }
  /// Which of these Suns a place is between (the column's own is one more), and how much of its light is spread as theirs.
  struct Between {
    std::size_t first = 0;
    double next = 0.0;  ///< share of the one after `first`
    double weight = 0.0;
  };
  /// `change`: of the same place.
  Between between_suns(std::size_t sublayer, double position, double sun_mu, const Change& change) const;
  /// Of the diffuse flux down at boundaries of sublayers.
  const std::vector<double>& flux_ratio() const { return flux_ratio_; }

 private:
  std::vector<double> angle_rad_;     ///< of the Sun from the zenith, rising
  std::vector<double> log_ratio_;     ///< [boundary][angle]
  std::vector<double> up_, sunward_;  ///< [boundary][angle]: changes over the mean radiance
  std::vector<double> log_flat_;      ///< [boundary]: of the mean radiance in flat layers
  std::vector<double> flux_ratio_;
  double own_rad_ = 0.0;
  std::vector<double> brighter_rad_;
  std::vector<std::vector<double>> own_over_;  ///< [brighter][boundary]
};

}  // namespace ifov::atmosphere
