#include "atmosphere/sensor/channel_emission.h"

#include <cmath>
#include <numbers>

#include "atmosphere/thermal/thermal_column.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {

ChannelEmission::ChannelEmission(const AtmosphereColumn& column, const ChannelPoints& points,
                                 const SensorGeometry& geometry, const SkyDirections& directions)
    : path(points.size()),
      sky_irradiance(points.size()),
      sky(directions.zenith_rad.size(), std::vector<double>(points.size())),
      line_of_sight_path(geometry.lines_of_sight.size(), std::vector<double>(points.size())),
      sky_at_height(geometry.heights_km.size(), std::vector<double>(points.size())) {
  const Levels& levels = column.levels();
  const double ground_km = levels.altitude_km.front();
  const GaussNodes hemisphere = gauss_nodes(8);
  std::vector<double> planck(levels.altitude_km.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const ChannelPoints::Point& point = points.points[p];
    const LayerOptics layers = point.layers();
    std::vector<double> depth = layers.gas_absorption;
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += layers.aerosol_absorption[i];
    for (std::size_t i = 0; i < planck.size(); ++i)
      planck[i] = radiometry::planck_w_m2_sr_um(point.wavelength_um, levels.temperature_K[i]);
    const ThermalColumn thermal(levels.altitude_km, planck, depth);
    path[p] =
        thermal.line_of_sight(geometry.sensor_altitude_km, std::cos(geometry.view_zenith_rad), ground_km)
            .radiance;
    for (std::size_t z = 0; z < sky.size(); ++z)
      sky[z][p] = thermal.sky(std::cos(directions.zenith_rad[z]), ground_km);
    const auto irradiance = [&](double altitude_km) {
      double sum = 0.0;
      for (std::size_t j = 0; j < hemisphere.position.size(); ++j)
        sum += 2.0 * std::numbers::pi * hemisphere.weight[j] * hemisphere.position[j] *
               thermal.sky(hemisphere.position[j], altitude_km);
      return sum;
    };
    sky_irradiance[p] = irradiance(ground_km);
    for (std::size_t h = 0; h < sky_at_height.size(); ++h)
      sky_at_height[h][p] = irradiance(ground_km + geometry.heights_km[h]);
    for (std::size_t s = 0; s < line_of_sight_path.size(); ++s) {
      const LineOfSight& line = geometry.lines_of_sight[s];
      line_of_sight_path[s][p] =
          thermal.line_of_sight(line.sensor_km, std::cos(line.zenith_rad), ground_km + line.height_km)
              .radiance;
    }
  }
}

}  // namespace ifov::atmosphere
