#pragma once

#include <cstddef>
#include <vector>

#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::transport {

/// Draws directions of a sky as a level surface sees it: with a density that follows radiance times the cosine of the
/// zenith angle, constant times that cosine within cells of a grid of directions. The sky is symmetric about the Sun's
/// plane.
class SkySampler {
 public:
  /// No sky: draws nothing.
  SkySampler() = default;
  /// `zenith_rad` and `azimuth_rad` (from the Sun's, 0 to pi) bound the cells, rising; `brightness` of each cell
  /// [zenith][azimuth] in any unit, not negative, some of it above 0.
  SkySampler(std::vector<double> zenith_rad, std::vector<double> azimuth_rad, math::Vec3 towards_sun,
             const std::vector<double>& brightness);

  bool empty() const { return cells_.empty(); }
  /// Unit, above the horizon.
  math::Vec3 sample(sampling::Point2 u) const;
  /// Of sample(), 1/sr; 0 at and below the horizon.
  double density(math::Vec3 direction) const;

 private:
  std::size_t azimuths() const { return azimuth_rad_.size() - 1; }
  std::vector<double> zenith_rad_, azimuth_rad_;
  std::vector<double> sine_squared_;  // of the zenith angles
  double sun_x_ = 0.0, sun_y_ = 1.0;  // horizontal direction of the Sun, unit
  std::vector<double> cells_;         // probability of a cell and its mirror image, [zenith][azimuth]
  std::vector<double> rows_;          // cumulative probability of rings, from 0 to 1
  std::vector<double> columns_;  // cumulative probability within a ring, from 0 to 1, [zenith][azimuth + 1]
};

}  // namespace ifov::transport
