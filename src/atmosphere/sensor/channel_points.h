#pragma once

#include <cstddef>
#include <optional>
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

  /// What scattered light is told relative to. `sun`, `view` and the others, but where they say nothing of it: under and above
  /// clouds, which hardly a beam comes through straight, what they would be without the clouds; of a Sun lower than 10 degrees
  /// above the horizon what they would be with the Sun there.
  struct Beams {
    std::vector<double> sun, view;
    std::vector<std::vector<double>> line_of_sight_view, sun_at_height;
    std::vector<double> sun_at_sensor = {};                 ///< as sun, down to the sensor's altitude
    std::vector<std::vector<double>> sun_at_line_end = {};  ///< [line], to that of the line's sensor
  };
  const std::vector<double>& sun_base() const { return base_ ? base_->sun : sun; }
  const std::vector<double>& view_base() const { return base_ ? base_->view : view; }
  const std::vector<double>& line_of_sight_base(std::size_t line) const {
    return base_ ? base_->line_of_sight_view[line] : line_of_sight_view[line];
  }
  const std::vector<double>& sun_at_height_base(std::size_t height) const {
    return base_ ? base_->sun_at_height[height] : sun_at_height[height];
  }
  bool has_base() const { return base_.has_value(); }
  /// Of sensors under clouds.
  const std::vector<double>& sun_at_sensor_base() const { return base_.value().sun_at_sensor; }
  const std::vector<double>& sun_at_line_end_base(std::size_t line) const {
    return base_.value().sun_at_line_end[line];
  }
  /// Whether light that is scattered into a line of sight from an altitude is told relative to the Sun's there, not to what is
  /// scattered once: below the top of a cloud.
  bool is_under_cloud(double sensor_km) const { return cloud_top_km_ && sensor_km < *cloud_top_km_; }
  bool cloudy() const { return cloud_top_km_.has_value(); }
  /// The same of other layers, one number each; of sunlight of irradiance 1.
  Beams base_of(const LayerOptics& layers) const;

  ChannelPoints(const AtmosphereColumn& column, const std::vector<ChannelBin>& bins, const BinOptics& optics,
                const SensorGeometry& geometry);
  std::size_t size() const { return points.size(); }

 private:
  std::vector<double> sun_slants_, view_slants_;  ///< by layer, of what is told relative to
  std::vector<double> sensor_slants_;
  std::vector<std::vector<double>> line_slants_, height_slants_, line_end_slants_;
  std::optional<Beams> base_;
  std::optional<double> cloud_top_km_;
};

}  // namespace ifov::atmosphere
