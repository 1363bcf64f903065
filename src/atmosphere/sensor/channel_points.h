#pragma once

#include <cstddef>
#include <vector>

#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_geometry.h"

namespace ifov::atmosphere {

/// Length of a straight line of sight within each layer (from the ground up) over the layer's thickness, from a height above
/// the ground up to the sensor: through shells about a round Earth, or in flat layers.
std::vector<double> view_slants(const std::vector<double>& altitude_km, const LineOfSight& line,
                                bool spherical);

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
