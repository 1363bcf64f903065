#pragma once

#include <functional>
#include <span>
#include <vector>

#include "atmosphere/scattering/scattering_options.h"
#include "radiometry/channel.h"

namespace ifov::atmosphere {

class AtmosphereColumn;
class SensorAtmosphere;
struct SensorGeometry;

/// What the air does to light in one part of a channel: a bin of the band model with one absorption term, or
/// a spectral node. Irradiances in W m-2 um-1, radiances in W m-2 sr-1 um-1, over black ground.
struct ChannelLight {
  double wavelength_um = 0.0;
  double weight = 0.0;  ///< of the channel; sums to 1
  double sun = 0.0;     ///< direct, on a surface that faces it
  double view = 0.0;    ///< direct transmittance to the sensor
  double path = 0.0;    ///< radiance that the path adds
  double diffuse_transmittance = 0.0, spherical_albedo = 0.0;
  double sky_irradiance = 0.0;
};

/// A channel with every bin and every term solved by itself: what the nodes of SensorAtmosphere stand for,
/// thousands of times as slow.
std::vector<ChannelLight> solve_all_terms(const AtmosphereColumn& column, const radiometry::Channel& channel,
                                          const radiometry::Spectrum& solar_irradiance,
                                          const SensorGeometry& geometry,
                                          const ScatteringOptions& options = {}, int threads = 0);

/// The same channel as nodes.
std::vector<ChannelLight> channel_nodes(const SensorAtmosphere& atmosphere, std::size_t channel);

/// Radiance at the sensor over endless Lambertian ground. By part: reflectance, and radiance that the ground
/// emits (empty: none).
double lambertian_radiance(std::span<const ChannelLight> parts, const SensorGeometry& geometry,
                           std::span<const double> reflectance, std::span<const double> emission = {});

}  // namespace ifov::atmosphere
