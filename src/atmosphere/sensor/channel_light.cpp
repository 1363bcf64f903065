#include "atmosphere/sensor/channel_light.h"

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/column/light_limits.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/thermal/emitted_light.h"
#include "core/parallel.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

/// Light of the Sun, if there is any, and of the ground.
void add_scattered(bool sunlit, const AtmosphereColumn& column, const LayerOptics& optics,
                   const SensorGeometry& geometry, const ColumnSolver& solver, double irradiance,
                   ChannelLight& light) {
  const double ground_km = column.levels().altitude_km.front(), mu = std::cos(geometry.view_zenith_rad);
  const ColumnSolution solution = solver.solve(column.levels(), optics, geometry.any_sun_zenith_rad());
  light.diffuse_transmittance = solution.diffuse_transmittance(mu, geometry.sensor_altitude_km).i;
  light.spherical_albedo = solution.spherical_albedo();
  if (!sunlit) return;
  light.sun = irradiance * solution.sun_transmittance(ground_km);
  light.path += irradiance * solution.sunlit()
                                 .line_of_sight({mu, geometry.view_azimuth_rad - std::numbers::pi},
                                                geometry.sensor_altitude_km, ground_km)
                                 .radiance()
                                 .i;
  light.sky_irradiance += irradiance * solution.sunlit().fluxes().at(ground_km).diffuse_down;
}

void add_emission(const AtmosphereColumn& column, const LayerOptics& optics, const SensorGeometry& geometry,
                  const ScatteringOptions& options, ChannelLight& light) {
  const Levels& levels = column.levels();
  const double ground_km = levels.altitude_km.front();
  std::vector<double> planck;
  for (const double t : levels.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(light.wavelength_um, t));
  const EmittedLight emitted(levels, optics, std::move(planck), options);
  light.path +=
      emitted.line_of_sight(geometry.sensor_altitude_km, std::cos(geometry.view_zenith_rad), ground_km);
  light.sky_irradiance += emitted.irradiance(ground_km);
}

}  // namespace

std::vector<ChannelLight> solve_all_terms(const AtmosphereColumn& column, const radiometry::Channel& channel,
                                          const radiometry::Spectrum& solar_irradiance,
                                          const SensorGeometry& geometry, const ScatteringOptions& options,
                                          int threads) {
  struct Part {
    ColumnOptics optics;
    std::size_t term;
    double irradiance;
  };
  std::vector<Part> parts;
  std::vector<ChannelLight> light;
  for (const ChannelBin& bin : channel_bins(channel, solar_irradiance, column.gas_terms())) {
    const ColumnOptics optics = column.at(bin.wavenumber_cm1);
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      parts.push_back({optics, term, bin.irradiance});
      light.emplace_back().wavelength_um = bin.wavelength_um;
      light.back().weight = bin.share * optics.weight(term);
    }
  }
  const ColumnSolver solver(options);
  const std::vector<double> slants =
      view_slants(column.levels().altitude_km, geometry.own_sight(), options.spherical_earth);
  parallel_for(static_cast<std::int64_t>(parts.size()), threads, [&](std::int64_t k) {
    const Part& part = parts[static_cast<std::size_t>(k)];
    ChannelLight& here = light[static_cast<std::size_t>(k)];
    const LayerOptics optics = part.optics.term(part.term);
    double depth = 0.0;
    for (std::size_t i = 0; i < optics.layers(); ++i)
      depth += slants[i] * (optics.gas_absorption[i] + optics.rayleigh_scattering[i] +
                            optics.aerosol_scattering[i] + optics.aerosol_absorption[i]);
    here.view = std::exp(-depth);
    const bool sunlit = geometry.sun_zenith_rad && here.wavelength_um <= kLastSolar_um;
    if (sunlit || here.wavelength_um >= kFirstThermal_um)
      add_scattered(sunlit, column, optics, geometry, solver, part.irradiance, here);
    if (here.wavelength_um >= kFirstThermal_um) add_emission(column, optics, geometry, options, here);
  });
  return light;
}

std::vector<ChannelLight> channel_nodes(const SensorAtmosphere& atmosphere, std::size_t channel) {
  std::vector<ChannelLight> light;
  const radiometry::SpectralNodes& nodes = atmosphere.nodes();
  for (std::size_t n = nodes.first_node(channel); n < nodes.first_node(channel + 1); ++n)
    light.push_back({nodes.node_wavelength_um(n), nodes.node_weight(n), atmosphere.sun_irradiance()[n],
                     atmosphere.view_transmittance()[n], atmosphere.view_radiance()[n],
                     atmosphere.diffuse_transmittance()[n], atmosphere.spherical_albedo()[n],
                     atmosphere.sky_irradiance()[n]});
  return light;
}

double lambertian_radiance(std::span<const ChannelLight> parts, const SensorGeometry& geometry,
                           std::span<const double> reflectance, std::span<const double> emission) {
  const double sine = geometry.sun_sine();
  double sum = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const ChannelLight& part = parts[k];
    const double rho = reflectance[k], emitted = emission.empty() ? 0.0 : emission[k];
    // Ground and air pass light back and forth.
    const double leaving = (rho * (part.sun * sine + part.sky_irradiance) / std::numbers::pi + emitted) /
                           (1.0 - rho * part.spherical_albedo);
    sum += part.weight * (part.path + leaving * (part.view + part.diffuse_transmittance));
  }
  return sum;
}

}  // namespace ifov::atmosphere
