#include "atmosphere/survey/survey_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "core/parallel.h"

namespace ifov::atmosphere {
namespace {

/// Channels that are worked out together, between reports of progress.
constexpr std::size_t kPart = 48;

/// Two rings of two directions: the sky's table is not looked at here.
SkyDirections fewest_directions() { return {{0.0, 1.0}, {0.0, std::numbers::pi}}; }

struct Part {
  const AtmosphereColumn& column;
  std::span<const radiometry::Channel> channels;
  SensorAtmosphere::Inputs inputs;
  double ground_reflectance;

  SensorAtmosphere solve(bool sunlit) const {
    SensorAtmosphere::Inputs asked = inputs;
    if (!sunlit) asked.geometry.sun_zenith_rad.reset();
    asked.polarized = sunlit;
    asked.geometry.level_fluxes = sunlit || !inputs.geometry.sun_zenith_rad;
    return SensorAtmosphere(column, asked);
  }
};

/// What is left of all light without the part; 0 where that is rounding.
double rest(double all, double part) { return all > part * (1.0 + 1e-12) ? all - part : 0.0; }

/// U of the line of sight, which azimuths clockwise from the Sun's are told of, where tables have that of the other side.
double own_side(const SensorGeometry& geometry, double u) {
  return std::sin(geometry.view_azimuth_rad) > 0.0 ? -u : u;
}

/// The same light over ground that reflects. Node by node: ground and air pass light back and forth in each as they absorb there.
void add_over_ground(const SensorAtmosphere& air, double reflectance, std::size_t n, double weight,
                     AtmosphereEffects::OverGround& to) {
  const SensorAtmosphere::LevelFluxes& level = air.level_fluxes();
  const double sine = air.geometry().sun_sine(), albedo = air.spherical_albedo()[n];
  const double down = air.sun_irradiance()[n] * sine + air.sky_irradiance()[n];
  const double up = reflectance * down / (1.0 - reflectance * albedo), leaving = up / std::numbers::pi;
  to.ground_diffuse += weight * (air.sky_irradiance()[n] + albedo * up);
  to.ground_up += weight * up;
  to.sensor_direct += weight * level.sun[n] * sine;
  to.sensor_diffuse += weight * (level.down[n] + level.ground_down[n] * up);
  to.sensor_up += weight * (level.up[n] + level.ground_up[n] * up);
  to.radiance += weight * (air.view_radiance()[n] +
                           leaving * (air.view_transmittance()[n] + air.diffuse_transmittance()[n]));
  if (!air.polarized()) return;
  const SensorAtmosphere::LineOfSightPolarization path = air.line_of_sight_polarization(0);
  to.q += weight * (path.q[n] + leaving * path.diffuse_q[n]);
  to.u += weight * own_side(air.geometry(), path.u[n]);
}

void survey_part(const Part& part, AtmosphereEffects* light) {
  std::vector<std::vector<ChannelBin>> bins;
  for (const radiometry::Channel& channel : part.channels)
    bins.push_back(channel_bins(channel, part.inputs.solar_irradiance, part.column.gas_terms()));
  const BinOptics optics(part.column, bins, part.inputs.threads);
  const SensorGeometry& geometry = part.inputs.geometry;
  parallel_for(static_cast<std::int64_t>(part.channels.size()), part.inputs.threads, [&](std::int64_t k) {
    const std::size_t c = static_cast<std::size_t>(k);
    light[c].wavelength_um = part.channels[c].centre_um;
    const ChannelPoints points(part.column, bins[c], optics, geometry);
    for (std::size_t p = 0; p < points.size(); ++p) {
      light[c].view_transmittance += points.share[p] * points.view[p];
      light[c].solar_irradiance += points.share[p] * points.irradiance[p];
    }
  });

  const auto add = [&](const SensorAtmosphere& air, auto&& use) {
    const radiometry::SpectralNodes& nodes = air.nodes();
    for (std::size_t c = 0; c < part.channels.size(); ++c)
      for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
        use(light[c], n, nodes.node_weight(n));
  };
  const SensorAtmosphere night = part.solve(false);
  add(night, [&](AtmosphereEffects& to, std::size_t n, double weight) {
    to.thermal_path += weight * night.view_radiance()[n];
    to.thermal_sky += weight * night.sky_irradiance()[n];
    if (!geometry.sun_zenith_rad) add_over_ground(night, part.ground_reflectance, n, weight, to.over_ground);
  });
  if (!geometry.sun_zenith_rad) return;
  const double sine = geometry.sun_sine();
  const SensorAtmosphere day = part.solve(true);
  add(day, [&](AtmosphereEffects& to, std::size_t n, double weight) {
    to.solar_path += weight * day.view_radiance()[n];
    to.solar_sky += weight * day.sky_irradiance()[n];
    to.direct_irradiance += weight * day.sun_irradiance()[n] * sine;
    to.diffuse_transmittance += weight * day.diffuse_transmittance()[n];
    to.spherical_albedo += weight * day.spherical_albedo()[n];
    to.path_q += weight * day.line_of_sight_polarization(0).q[n];
    to.path_u += weight * own_side(geometry, day.line_of_sight_polarization(0).u[n]);
    add_over_ground(day, part.ground_reflectance, n, weight, to.over_ground);
  });
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    AtmosphereEffects& of = light[c];
    constexpr double kNothing = 1e-100;  // what tables of logarithms have for 0
    if (of.over_ground.sensor_diffuse < kNothing * of.solar_irradiance) of.over_ground.sensor_diffuse = 0.0;
    of.solar_path = rest(of.solar_path, of.thermal_path);
    of.solar_sky = rest(of.solar_sky, of.thermal_sky);
    of.sun_transmittance =
        of.solar_irradiance > 0.0 && sine > 0.0 ? of.direct_irradiance / (sine * of.solar_irradiance) : 0.0;
  }
}

}  // namespace

std::vector<AtmosphereEffects> survey_effects(const AtmosphereColumn& column,
                                              std::span<const radiometry::Channel> channels,
                                              const radiometry::Spectrum& solar_irradiance,
                                              const SensorGeometry& geometry, const SurveyControl& control) {
  std::vector<AtmosphereEffects> light(channels.size());
  for (std::size_t first = 0; first < channels.size(); first += kPart) {
    if (control.progress) control.progress(first);
    const auto some = channels.subspan(first, std::min(kPart, channels.size() - first));
    Part part{column, some, {}, control.ground_reflectance};
    part.inputs.channels = some;
    part.inputs.solar_irradiance = solar_irradiance;
    part.inputs.demands.most_nodes = control.most_nodes;
    part.inputs.geometry = geometry;
    part.inputs.sky = fewest_directions();
    part.inputs.threads = control.threads;
    survey_part(part, light.data() + first);
  }
  if (control.progress) control.progress(channels.size());
  return light;
}

std::vector<radiometry::Channel> resolved_steps(double first_um, double last_um, const GasTermTable* terms,
                                                std::size_t most) {
  double low = 1e4 / last_um, high = 1e4 / first_um, step = kResolution_cm1, begin = 0.0;
  if (terms != nullptr) {
    step = terms->step_cm1, begin = terms->first_cm1;
    low = std::max(low, begin), high = std::min(high, terms->last_cm1());
  }
  step *= std::max(1.0, std::ceil((high - low) / (step * static_cast<double>(most))));
  // Edges may be off by rounding: no step of nothing.
  const double end = terms != nullptr ? std::min(high, terms->last_cm1() - 0.99 * step) : high;
  std::vector<radiometry::Channel> channels;
  for (double from = begin + std::floor((low - begin) / step) * step; from < end; from += step)
    channels.push_back(radiometry::Channel::top_hat(format("{:g} cm-1", from + 0.5 * step),
                                                    1e4 / (from + step), 1e4 / from));
  std::reverse(channels.begin(), channels.end());
  return channels;
}

}  // namespace ifov::atmosphere
