#include <chrono>
#include <numbers>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "radiometry/solar_spectrum.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {
namespace {

double seconds_to_build(std::span<const radiometry::Channel> channels) {
  constexpr int kThreads = 2;
  atmosphere::SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::solar_irradiance_1au();
  inputs.demands.tolerance = 5e-3;
  inputs.with_errors = true;
  inputs.demands.most_nodes = 8;
  const bool warm = channels.front().centre_um > 2.5;
  inputs.demands.coldest_k = warm ? 260.0 : 0.0;
  inputs.demands.hottest_k = warm ? 340.0 : 0.0;
  inputs.geometry.sun_zenith_rad = 40.0 * std::numbers::pi / 180.0;
  inputs.threads = kThreads;
  const auto start = std::chrono::steady_clock::now();
  const atmosphere::SensorAtmosphere air(atmosphere::AtmosphereColumn{atmosphere::AtmosphereDescription{}},
                                         inputs);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

AtmosphereSection speed_section(const AtmosphereOptions&) {
  AtmosphereSection section;
  section.title = "Speed";
  section.text =
      "Time to build the tables of a sensor from nothing, on two threads, with polarized scattering and the estimate of its own errors. Memory, "
      "and what the "
      "atmosphere adds to a path, are measured by `make bench BENCH=atmosphere`.";
  std::vector<radiometry::Channel> vswir, thermal, few;
  for (int k = 0; k < 210; ++k)
    vswir.push_back(radiometry::Channel::gaussian("", 0.4 + 2.1 * k / 209.0, 0.01));
  for (int k = 0; k < 10; ++k) thermal.push_back(radiometry::Channel::gaussian("", 8.2 + 0.45 * k, 0.4));
  for (const auto& [first, last] : {std::pair{0.452, 0.512},
                                    {0.533, 0.590},
                                    {0.636, 0.673},
                                    {0.851, 0.879},
                                    {1.566, 1.651},
                                    {2.107, 2.294}})
    few.push_back(radiometry::Channel::top_hat("", first, last));
  section.figures.at_most("tables_vswir_s", seconds_to_build(vswir), 60.0, "s",
                          "210 channels of 10 nm, 0.4 to 2.5 um");
  section.figures.at_most("tables_thermal_s", seconds_to_build(thermal), 20.0, "s",
                          "10 thermal channels, 8 to 12.5 um");
  section.figures.at_most("tables_multispectral_s", seconds_to_build(few), 2.0, "s",
                          "6 multispectral channels, nadir");
  return section;
}

}  // namespace ifov::studies
