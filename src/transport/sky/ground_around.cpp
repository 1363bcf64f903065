#include "transport/sky/ground_around.h"

#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/stokes.h"

namespace ifov::transport {

double GroundAround::sky(const atmosphere::SensorAtmosphere& air, std::size_t zenith, std::size_t azimuth,
                         std::size_t node) const {
  const double light = air.sky(zenith, azimuth, node) + even[node] * air.groundlit_sky(zenith, node);
  if (shaped.empty()) return light;
  const std::size_t row = zenith * air.sky_directions().azimuth_rad.size() + azimuth;
  return light + shaped[node] * air.directional()->sky_i[row * air.node_count() + node];
}

radiometry::StokesVector GroundAround::sky_stokes(const atmosphere::SensorAtmosphere& air, std::size_t zenith,
                                                  std::size_t azimuth, std::size_t node) const {
  const radiometry::StokesVector light =
      air.sky_stokes(zenith, azimuth, node) + even[node] * air.groundlit_sky_stokes(zenith, node);
  if (shaped.empty()) return light;
  const atmosphere::DirectionalLight& ground = *air.directional();
  const std::size_t at =
      (zenith * air.sky_directions().azimuth_rad.size() + azimuth) * air.node_count() + node;
  return light +
         shaped[node] * radiometry::StokesVector{ground.sky_i[at], ground.sky_q[at], ground.sky_u[at], 0.0};
}

double GroundAround::path(const atmosphere::SensorAtmosphere& air, std::size_t line, std::size_t node) const {
  const double light = even[node] * air.line_of_sight(line).diffuse_transmittance[node];
  return shaped.empty() ? light
                        : light + shaped[node] * air.directional()->path_i[line * air.node_count() + node];
}

radiometry::StokesVector GroundAround::path_stokes(const atmosphere::SensorAtmosphere& air, std::size_t line,
                                                   std::size_t node) const {
  radiometry::StokesVector light{path(air, line, node),
                                 even[node] * air.line_of_sight_polarization(line).diffuse_q[node], 0.0, 0.0};
  if (shaped.empty()) return light;
  const std::size_t at = line * air.node_count() + node;
  light.q += shaped[node] * air.directional()->path_q[at];
  light.u += shaped[node] * air.directional()->path_u[at];
  return light;
}

}  // namespace ifov::transport
