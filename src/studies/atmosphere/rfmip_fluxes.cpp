#include "studies/atmosphere/rfmip_fluxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/model_error_table.h"
#include "atmosphere/survey/broadband_fluxes.h"
#include "core/parallel.h"
#include "io/raster/netcdf_variable.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "studies/atmosphere/sky_emission.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;
constexpr std::size_t kLevels = 61, kLayers = 60;
constexpr double kPi = std::numbers::pi;
/// As longwave_down_w_m2() has them.
constexpr double kFirst_cm1 = 200.0, kLastThermal_cm1 = 3250.0;

/// Everything of the first experiment.
struct Inputs {
  std::vector<double> pressure_Pa, layer_pressure_Pa, temperature_K, water, ozone, zenith_deg, albedo,
      irradiance, weight, longwave, shortwave;
  double co2_ppm, ch4_ppm, n2o_ppm;

  explicit Inputs(const std::filesystem::path& folder) {
    const auto read = [&](const char* file, const char* name) {
      return io::read_netcdf_variable(folder / file, name).values;
    };
    const char* inputs = "rfmip_inputs.nc";
    pressure_Pa = read(inputs, "pres_level");
    layer_pressure_Pa = read(inputs, "pres_layer");
    temperature_K = read(inputs, "temp_level");
    water = read(inputs, "water_vapor");
    ozone = read(inputs, "ozone");
    zenith_deg = read(inputs, "solar_zenith_angle");
    albedo = read(inputs, "surface_albedo");
    irradiance = read(inputs, "total_solar_irradiance");
    weight = read(inputs, "profile_weight");
    longwave = read("rld.nc", "rld");
    shortwave = read("rsd.nc", "rsd");
    co2_ppm = read(inputs, "carbon_dioxide_GM")[0];
    ch4_ppm = 1e-3 * read(inputs, "methane_GM")[0];
    n2o_ppm = 1e-3 * read(inputs, "nitrous_oxide_GM")[0];
  }
};

/// The site's levels, from the ground up, at altitudes by the hydrostatic law.
AtmosphereDescription described(const Inputs& inputs, std::size_t site, double water_share) {
  const double* pressure = &inputs.pressure_Pa[site * kLevels];
  const double* temperature = &inputs.temperature_K[site * kLevels];
  const bool falling = pressure[0] > pressure[kLevels - 1];
  const auto level = [&](std::size_t k) { return falling ? k : kLevels - 1 - k; };
  const auto at_level = [&](const std::vector<double>& layers, std::size_t k) {
    const std::size_t a = std::min(level(k), kLayers - 1), b = level(k) == 0 ? 0 : level(k) - 1;
    return 0.5 * (layers[site * kLayers + a] + layers[site * kLayers + b]);
  };
  AtmosphereDescription description;
  description.air.model = "US standard 1976";
  description.air.limit_humidity = false;
  description.air.co2_ppm = inputs.co2_ppm;
  description.air.ch4_ppm = inputs.ch4_ppm;
  description.air.n2o_ppm = inputs.n2o_ppm;
  description.aerosol.type = "none";
  double altitude_km = 0.0;
  for (std::size_t k = 0; k < kLevels; ++k) {
    const std::size_t here = level(k);
    if (k > 0) {
      const std::size_t below = level(k - 1);
      const double warm = 0.5 * (temperature[here] + temperature[below]);
      altitude_km += 1e-3 * 287.05 * warm * (1.0 + 0.61 * 0.622 * at_level(inputs.water, k)) / 9.80665 *
                     std::log(pressure[below] / pressure[here]);
    }
    if (altitude_km > 80.0) break;
    UserLevel& user = description.air.levels.emplace_back();
    user.altitude_km = altitude_km;
    user.pressure_hPa = 1e-2 * pressure[here];
    user.temperature_K = temperature[here];
    user.mixing_ratio_g_kg = 1e3 * 0.622 * water_share * at_level(inputs.water, k);
    user.ozone_ppmv = 1e6 * at_level(inputs.ozone, k);
  }
  return description;
}

/// What the table of the model's error makes of the same flux, errors of all wavenumbers of one sign. Below the first the model says
/// nothing of itself.
double longwave_stated(const AtmosphereColumn& column) {
  constexpr double kStep_cm1 = 20.0;
  const ModelErrorTable& table = ModelErrorTable::built_in();
  const EmittingColumn emitting(column, table);
  double sum = 0.0;
  for (double nu = kFirst_cm1; nu < kLastThermal_cm1; nu += kStep_cm1) {
    const SkyEmission sky = emitting.flux(nu, 4);
    sum += kStep_cm1 * (sky.by_depth + table.at(1e4 / nu).emitted * sky.radiance) * 1e4 / (nu * nu);
  }
  return sum;
}

/// Sunlight at the ground, and what the table says that it may be off by: the beam by its gases, the sky by these and by what molecules
/// scatter.
struct Sunlight {
  double flux = 0.0, stated = 0.0;
};

Sunlight shortwave_down(const AtmosphereColumn& column, double zenith_rad, double albedo,
                        double total_irradiance, double step_cm1) {
  ScatteringOptions options;
  options.nodes_per_hemisphere = 4;
  options.polarized = false;
  options.sublayer_depth = 0.05;
  options.spherical_earth = false;  // as the reference has it
  const ColumnSolver solver(options);
  const radiometry::Spectrum& spectrum = radiometry::solar_irradiance_1au();
  constexpr double kLast_cm1 = 49000.0;
  const double ground_km = column.levels().altitude_km.front(), slant = 1.0 / std::cos(zenith_rad);
  const Profile& profile = column.profile();
  GasAmounts beam = vertical_amounts(profile, ground_km, ground_km);
  beam.add(vertical_amounts(profile, ground_km, 100.0), slant);
  const double air = slant, water = slant * profile.between(ground_km, 100.0).precipitable_water_g_cm2();
  const ModelErrorTable& table = ModelErrorTable::built_in();
  double sum = 0.0, stated = 0.0, all = 0.0;
  for (double nu = 1000.0; nu < kLast_cm1; nu += step_cm1) {
    double irradiance = 0.0;  // of the step
    for (double at = nu - 0.5 * step_cm1 + 2.5; at < nu + 0.5 * step_cm1; at += 5.0)
      irradiance += spectrum.at(1e4 / at) * 5.0 * 1e4 / (at * at);
    all += irradiance;
    const ColumnOptics optics = column.at(nu);
    const double gas =
        -std::log(std::max(1e-30, gas_transmittance(nu, beam, column.description().gas_model)));
    const double by_gas = std::expm1(table.of_depth(1e4 / nu, {air, water, gas, 0.0})),
                 by_scattering = table.of_scattered(1e4 / nu, 0.0);
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const ColumnSolution solution = solver.solve(column.levels(), optics.term(term), zenith_rad);
      const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(ground_km);
      const double light = irradiance * optics.weight(term) / (1.0 - albedo * solution.spherical_albedo());
      sum += light * (fluxes.direct_down + fluxes.diffuse_down);
      stated +=
          light * (by_gas * (fluxes.direct_down + fluxes.diffuse_down) + by_scattering * fluxes.diffuse_down);
    }
  }
  return {sum * total_irradiance / all, stated * total_irradiance / all};
}

}  // namespace

std::vector<RfmipColumn> rfmip_fluxes(const std::filesystem::path& folder, std::span<const std::size_t> sites,
                                      const RfmipQuestion& question) {
  const Inputs inputs(folder);
  std::vector<RfmipColumn> columns(sites.size());
  parallel_for(static_cast<std::int64_t>(sites.size()), question.threads, [&](std::int64_t k) {
    const std::size_t site = sites[static_cast<std::size_t>(k)];
    RfmipColumn& result = columns[static_cast<std::size_t>(k)];
    const AtmosphereColumn column(described(inputs, site, question.water_share));
    const double* pressure = &inputs.pressure_Pa[site * kLevels];
    const std::size_t ground = pressure[0] > pressure[kLevels - 1] ? 0 : kLevels - 1;
    result.site = site;
    result.weight = inputs.weight[site];
    result.longwave = longwave_down_w_m2(column, question.longwave_step_cm1, 1);
    result.longwave_stated = longwave_stated(column);
    result.longwave_reference = inputs.longwave[site * kLevels + ground];
    const double zenith_rad = inputs.zenith_deg[site] * kPi / 180.0;
    if (zenith_rad > 85.0 * kPi / 180.0) return;
    for (std::size_t l = 0; l < kLayers; ++l)
      result.water_in_beam_g_cm2 += 0.1 * 0.622 * question.water_share * inputs.water[site * kLayers + l] *
                                    std::abs(pressure[l + 1] - pressure[l]) / 9.80665 / std::cos(zenith_rad);
    const Sunlight sunlight = shortwave_down(column, zenith_rad, inputs.albedo[site], inputs.irradiance[site],
                                             question.shortwave_step_cm1);
    result.shortwave = sunlight.flux, result.shortwave_stated = sunlight.stated;
    result.shortwave_reference = inputs.shortwave[site * kLevels + ground];
  });
  return columns;
}

}  // namespace ifov::studies
