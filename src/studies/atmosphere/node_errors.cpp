#include "studies/atmosphere/node_errors.h"

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "io/library/material_library.h"
#include "math/angle.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::studies {

NodeErrors node_errors(std::span<const radiometry::Channel> channels, const NodeQuestion& question) {
  using namespace atmosphere;
  constexpr double kGround_k = 300.0, kFirstWarm_um = 2.5;
  const AtmosphereColumn column{AtmosphereDescription{}};
  SensorGeometry geometry;
  geometry.sun_zenith_rad = 40.0 * math::kDegree;
  geometry.view_zenith_rad = 10.0 * math::kDegree;
  geometry.view_azimuth_rad = 110.0 * math::kDegree;
  ScatteringOptions rough;
  rough.nodes_per_hemisphere = 4;
  rough.polarized = false;
  rough.sublayer_depth = 0.05;

  NodeErrors errors;
  std::vector<radiometry::Spectrum> surfaces;
  for (const double reflectance : {0.05, 0.2, 0.5}) {
    errors.surfaces.push_back(format("reflectance {:g}", reflectance));
    surfaces.push_back(radiometry::Spectrum::constant(reflectance));
  }
  if (question.whole_library) {
    errors.surfaces.clear(), surfaces.clear();
    for (const io::LibraryMaterial& material : io::material_library().materials()) {
      errors.surfaces.push_back(material.name);
      surfaces.push_back(material.curves[0].reflectance);
    }
  } else {
    errors.surfaces.push_back("grass");
    surfaces.push_back(io::material_library().find("grass, lawn").curves[0].reflectance);
  }

  SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::solar_irradiance_1au();
  inputs.surfaces = surfaces;
  inputs.geometry = geometry;
  inputs.scattering = rough;
  inputs.threads = question.threads;
  inputs.demands.tolerance = question.tolerance;
  inputs.demands.most_nodes = question.most_nodes;
  inputs.demands.all_glow = question.whole_library;
  const bool warm = channels.front().centre_um > kFirstWarm_um;
  inputs.demands.coldest_k = warm ? 260.0 : 0.0;
  inputs.demands.hottest_k = warm ? 340.0 : 0.0;
  const SensorAtmosphere atmosphere(column, inputs);
  errors.nodes = atmosphere.node_count();
  errors.relative.resize(surfaces.size());
  std::vector<float> reflectance(atmosphere.node_count()), planck(atmosphere.node_count());
  atmosphere.nodes().planck(kGround_k, std::span<float>(planck));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    errors.centre_um.push_back(channels[c].centre_um);
    errors.claimed.push_back(atmosphere.nodes().worst_error(c));
    const auto all =
        solve_all_terms(column, channels[c], inputs.solar_irradiance, geometry, rough, question.threads);
    const auto nodes = channel_nodes(atmosphere, c);
    const std::size_t first = atmosphere.nodes().first_node(c);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      atmosphere.nodes().average_surface(surfaces[s], reflectance);
      std::vector<double> at_all, at_nodes, glow_all, glow_nodes;
      for (const ChannelLight& part : all) {
        at_all.push_back(surfaces[s].at(part.wavelength_um));
        glow_all.push_back(warm ? (1.0 - at_all.back()) *
                                      radiometry::planck_w_m2_sr_um(part.wavelength_um, kGround_k)
                                : 0.0);
      }
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        at_nodes.push_back(reflectance[first + n]);
        glow_nodes.push_back(warm ? (1.0 - at_nodes.back()) * planck[first + n] : 0.0);
      }
      errors.relative[s].push_back(lambertian_radiance(nodes, geometry, at_nodes, glow_nodes) /
                                       lambertian_radiance(all, geometry, at_all, glow_all) -
                                   1.0);
    }
  }
  return errors;
}

}  // namespace ifov::studies
