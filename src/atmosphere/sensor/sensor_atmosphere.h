#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_bins.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::atmosphere {

/// Light of a ground of radiance 1 in every direction is what the "groundlit" quantities are for.
struct SensorGeometry {
  /// Of the Sun at the ground; none: night.
  std::optional<double> sun_zenith_rad;
  /// From the ground towards the sensor.
  double view_zenith_rad = 0.0;
  /// Of that direction from the Sun's.
  double view_azimuth_rad = 0.0;
  /// Above mean sea level; at or above the top of the air it is the same everywhere.
  double sensor_altitude_km = 100.0;
};

/// Directions of the sky's table: zenith angles from 0 to just below 90 degrees, azimuths from the Sun's, 0 to pi (the
/// sky is symmetric about the Sun's plane).
struct SkyDirections {
  std::vector<double> zenith_rad, azimuth_rad;
  static SkyDirections standard();
};

/// The atmosphere as one sensor's channels see it: spectral nodes, and what the air does to light in each of them. A
/// node stands for those parts of a channel (bins of the band model and their absorption terms) that the air absorbs
/// alike, so that absorption on the way down and on the way up stay correlated: within a node Beer's law holds along any
/// path. Radiances are for black ground; what the ground adds follows from the groundlit quantities
/// (docs/theory/atmosphere_sensor.md).
class SensorAtmosphere {
 public:
  struct Inputs {
    std::span<const radiometry::Channel> channels;
    radiometry::Spectrum solar_irradiance;  ///< above the air, at the date's distance, W m-2 um-1
    std::span<const radiometry::Spectrum> surfaces;
    radiometry::NodeDemands demands;
    SensorGeometry geometry;
    SkyDirections sky = SkyDirections::standard();
    int threads = 0;
  };
  SensorAtmosphere(const AtmosphereColumn& column, const Inputs& inputs);

  const radiometry::SpectralNodes& nodes() const { return nodes_; }
  std::size_t node_count() const { return nodes_.node_count(); }
  const SensorGeometry& geometry() const { return geometry_; }
  const SkyDirections& sky_directions() const { return directions_; }

  /// By node. Irradiances in W m-2 um-1, radiances in W m-2 sr-1 um-1.
  const std::vector<double>& sun_irradiance() const { return sun_; }       ///< direct, on a surface that faces it
  const std::vector<double>& view_transmittance() const { return view_transmittance_; }  ///< direct
  const std::vector<double>& view_radiance() const { return view_radiance_; }  ///< scattered sunlight and emission
  const std::vector<double>& diffuse_transmittance() const { return diffuse_transmittance_; }  ///< groundlit, to the sensor
  const std::vector<double>& spherical_albedo() const { return spherical_albedo_; }
  const std::vector<double>& sky_irradiance() const { return sky_irradiance_; }  ///< on a level surface
  /// Radiance from a direction of the table: [zenith][azimuth][node], and the groundlit sky [zenith][node].
  double sky(std::size_t zenith, std::size_t azimuth, std::size_t node) const {
    return sky_[(zenith * directions_.azimuth_rad.size() + azimuth) * node_count() + node];
  }
  double groundlit_sky(std::size_t zenith, std::size_t node) const { return groundlit_[zenith * node_count() + node]; }

  /// Channels narrower than the band model resolves, by index.
  const std::vector<std::size_t>& unresolved_channels() const { return unresolved_; }

 private:
  struct ChannelState;
  void build_nodes(const AtmosphereColumn& column, const Inputs& inputs, std::vector<ChannelState>& states);
  void add_thermal(const AtmosphereColumn& column, std::vector<ChannelState>& states, int threads);
  void add_scattering(const AtmosphereColumn& column, std::vector<ChannelState>& states, int threads);

  SensorGeometry geometry_;
  SkyDirections directions_;
  radiometry::SpectralNodes nodes_;
  std::vector<double> sun_, view_transmittance_, view_radiance_, diffuse_transmittance_, spherical_albedo_,
      sky_irradiance_, sky_, groundlit_;
  std::vector<std::size_t> unresolved_;
};

}  // namespace ifov::atmosphere
