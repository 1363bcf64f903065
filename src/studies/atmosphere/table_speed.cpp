#include "studies/atmosphere/table_speed.h"

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "io/library/material_library.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::studies {
namespace {

std::vector<radiometry::Channel> gaussians(int count, double first_um, double last_um, double width_um) {
  std::vector<radiometry::Channel> channels;
  for (int k = 0; k < count; ++k)
    channels.push_back(
        radiometry::Channel::gaussian("", first_um + (last_um - first_um) * k / (count - 1.0), width_um));
  return channels;
}

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

}  // namespace

std::vector<radiometry::Channel> timed_vswir() { return gaussians(210, 0.4, 2.5, 0.01); }
std::vector<radiometry::Channel> timed_thermal() { return gaussians(10, 8.2, 12.25, 0.4); }
std::vector<radiometry::Channel> timed_multispectral() {
  std::vector<radiometry::Channel> channels;
  for (const auto& [first, last] : {std::pair{0.435, 0.451},
                                    {0.452, 0.512},
                                    {0.533, 0.590},
                                    {0.636, 0.673},
                                    {0.851, 0.879},
                                    {1.566, 1.651},
                                    {2.107, 2.294},
                                    {0.503, 0.676},
                                    {1.363, 1.384}})
    channels.push_back(radiometry::Channel::top_hat("", first, last));
  return channels;
}

TableSpeed time_tables(std::span<const radiometry::Channel> channels, int threads) {
  const radiometry::Spectrum surfaces[] = {
      io::material_library().find("grass, lawn").curves[0].reflectance,
      io::material_library().find("asphalt, black").curves[0].reflectance};
  atmosphere::SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::solar_irradiance_1au();
  inputs.surfaces = surfaces;
  inputs.demands.tolerance = 5e-3;
  inputs.demands.most_nodes = 8;
  const bool warm = channels.front().centre_um > 2.5;
  inputs.demands.coldest_k = warm ? 260.0 : 0.0;
  inputs.demands.hottest_k = warm ? 340.0 : 0.0;
  inputs.geometry.sun_zenith_rad = 40.0 * std::numbers::pi / 180.0;
  inputs.with_errors = true;
  inputs.ground = surfaces[0];
  inputs.threads = threads;
  const double cpu_before = user_seconds();
  const auto start = std::chrono::steady_clock::now();
  const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
  const atmosphere::SensorAtmosphere air(column, inputs);
  TableSpeed speed;
  speed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  speed.cpu_seconds = user_seconds() - cpu_before;
  speed.nodes = air.node_count();
  const auto all =
      atmosphere::solve_all_terms(column, channels.front(), inputs.solar_irradiance, inputs.geometry);
  const auto nodes = atmosphere::channel_nodes(air, 0);
  const std::vector<double> at_all(all.size(), 0.2), at_nodes(nodes.size(), 0.2);
  const double expected = atmosphere::lambertian_radiance(all, inputs.geometry, at_all);
  const double found = atmosphere::lambertian_radiance(nodes, inputs.geometry, at_nodes);
  speed.right = std::abs(found / expected - 1.0) < 0.005;
  return speed;
}

}  // namespace ifov::studies
