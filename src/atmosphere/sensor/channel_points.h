#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/line_of_sight_grid.h"

namespace ifov::atmosphere {

struct SensorGeometry {
  /// Of the Sun at the ground; none: night.
  std::optional<double> sun_zenith_rad;
  /// From the ground towards the sensor.
  double view_zenith_rad = 0.0;
  /// Of that direction from the Sun's, either way round: the air is the same on both sides of the Sun's plane,
  /// but for the sign of U.
  double view_azimuth_rad = 0.0;
  /// Above mean sea level; at or above the top of the air it is the same everywhere.
  double sensor_altitude_km = 100.0;
  /// Further lines of sight that are wanted, each with its own sensor's altitude, and further heights of surfaces above
  /// the ground.
  std::vector<LineOfSight> lines_of_sight = {};
  std::vector<double> heights_km = {};

  /// The Sun for a solution of which only what comes from the ground is wanted.
  double any_sun_zenith_rad() const { return sun_zenith_rad.value_or(0.7); }
  /// The sensor's own line of sight, from the ground.
  LineOfSight own_sight() const { return {view_zenith_rad, view_azimuth_rad, 0.0, sensor_altitude_km}; }
  /// The same without these.
  SensorGeometry alone() const {
    SensorGeometry geometry = *this;
    geometry.lines_of_sight.clear();
    geometry.heights_km.clear();
    return geometry;
  }
};

/// Length of the straight path from the surface of a line of sight up to the sensor; endless from the ground itself.
double line_of_sight_length_km(const LineOfSight& line, double ground_km);

/// A channel as its points: bins of the band model, term by term, with what is exact at each of them.
struct ChannelPoints {
  struct Point {
    const ColumnOptics* optics = nullptr;
    std::size_t term = 0;
    double wavelength_um = 0.0;
    LayerOptics layers() const { return optics->term(term); }
  };
  std::vector<Point> points;
  std::vector<double> share;       ///< of the channel's response; sums to 1
  std::vector<double> irradiance;  ///< of the Sun above the air, W m-2 um-1
  std::vector<double> sun;         ///< direct, at the ground on a surface that faces the Sun
  std::vector<double> view;        ///< direct transmittance from the ground to the sensor
  std::vector<std::vector<double>> line_of_sight_view;  ///< [line], as view
  std::vector<std::vector<double>> sun_at_height;       ///< [height], as sun
  std::vector<double> gas_depth;                        ///< vertical absorption depth of all gas

  ChannelPoints(const AtmosphereColumn& column, const std::vector<ChannelBin>& bins, const BinOptics& optics,
                const SensorGeometry& geometry);
  std::size_t size() const { return points.size(); }
};

}  // namespace ifov::atmosphere
