#include "atmosphere/sensor/channel_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {
namespace {

/// Length of the sunbeam within each layer over the layer's thickness, on a spherical Earth.
std::vector<double> sun_slants(const std::vector<double>& altitude_km, double zenith_rad) {
  const double ground = altitude_km.front(), mu = std::cos(zenith_rad);
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i)
    slants.push_back((length_to_shell_km(ground, mu, altitude_km[i + 1]) -
                      length_to_shell_km(ground, mu, altitude_km[i])) /
                     (altitude_km[i + 1] - altitude_km[i]));
  return slants;
}

/// The same for a straight line of sight in flat layers, up to the sensor.
std::vector<double> view_slants(const std::vector<double>& altitude_km, const SensorGeometry& geometry) {
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i) {
    const double crossed =
        (geometry.sensor_altitude_km - altitude_km[i]) / (altitude_km[i + 1] - altitude_km[i]);
    slants.push_back(std::clamp(crossed, 0.0, 1.0) / std::cos(geometry.view_zenith_rad));
  }
  return slants;
}

}  // namespace

ChannelPoints::ChannelPoints(const AtmosphereColumn& column, const std::vector<ChannelBin>& bins,
                             const BinOptics& optics, const SensorGeometry& geometry) {
  const std::vector<double>& altitude_km = column.levels().altitude_km;
  const std::vector<double> up = view_slants(altitude_km, geometry);
  const std::vector<double> down = sun_slants(altitude_km, geometry.sun_zenith_rad.value_or(0.0));
  for (const ChannelBin& bin : bins) {
    const ColumnOptics& at = optics.at(bin.bin);
    for (std::size_t term = 0; term < at.terms(); ++term) {
      const LayerOptics layers = at.term(term);
      double sun_depth = 0.0, view_depth = 0.0;
      for (std::size_t i = 0; i < layers.layers(); ++i) {
        const double depth = layers.gas_absorption[i] + layers.rayleigh_scattering[i] +
                             layers.aerosol_scattering[i] + layers.aerosol_absorption[i];
        sun_depth += down[i] * depth;
        view_depth += up[i] * depth;
      }
      points.push_back({&at, term, bin.wavelength_um});
      share.push_back(bin.share * at.weight(term));
      irradiance.push_back(bin.irradiance);
      sun.push_back(geometry.sun_zenith_rad ? bin.irradiance * std::exp(-sun_depth) : 0.0);
      view.push_back(std::exp(-view_depth));
      gas_depth.push_back(std::accumulate(layers.gas_absorption.begin(), layers.gas_absorption.end(), 0.0));
    }
  }
}

}  // namespace ifov::atmosphere
