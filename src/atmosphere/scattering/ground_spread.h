#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "atmosphere/layer_optics.h"

namespace ifov::atmosphere {

/// From which places of level ground the light comes that the air scatters into a line of sight: the point-spread
/// function of the diffuse transmittance t_d, or, of a place on the ground, of the spherical albedo S. Ground of radiance 1
/// all around sends t_d into the line; GroundSpread says how that is shared out by distance and direction from where the
/// line meets the ground. By reciprocity it is where light that goes down the line of sight lands once it was scattered
/// (docs/theory/atmosphere_adjacency.md). The ground is black: light that goes back and forth is the caller's.
class GroundSpread {
 public:
  /// Rings about the place: ring k lies between ring_edges_km()[k] and [k + 1], the first begins at 0, the last has no end.
  static constexpr std::size_t kRings = 40;
  /// Of each ring, counterclockwise seen from above: the first is centred on the azimuth towards the sensor.
  static constexpr std::size_t kSectors = 16;
  static const std::array<double, kRings>& inner_edges_km();

  struct Sight {
    double zenith_rad = 0.0;   ///< of the direction from the ground towards the sensor; below 90 degrees
    double sensor_km = 100.0;  ///< above mean sea level
    bool from_ground =
        false;  ///< of the light that the sky sends back on level ground; the two others do not matter
  };
  /// Monte Carlo with `photons` that start in an even sequence. The same numbers give the same spread.
  GroundSpread(const std::vector<double>& altitude_km, const LayerOptics& layers, const Sight& sight,
               std::size_t photons, std::uint64_t seed = 0);

  /// t_d (or S) of this column, and the standard error of either.
  double transmittance() const { return transmittance_; }
  double standard_error() const { return standard_error_; }
  /// So many photons of one weight would tell shares as well: (sum w)^2 / sum w^2.
  double effective_photons() const { return effective_photons_; }
  /// Shares [ring][sector], which add up to 1 (all 0 where nothing is scattered down).
  std::span<const double> shares() const { return shares_; }
  /// What comes from within a distance, between edges as if even over the logarithm; within the first edge even over
  /// distance.
  double within(double distance_km) const;

 private:
  std::vector<double> shares_;
  double transmittance_ = 0.0, standard_error_ = 0.0, effective_photons_ = 0.0;
};

}  // namespace ifov::atmosphere
