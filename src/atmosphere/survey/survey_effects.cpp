#include "atmosphere/survey/survey_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/sensor/sky_over_ground.h"
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
  const radiometry::Spectrum& ground;

  SensorAtmosphere solve(bool sunlit) const {
    SensorAtmosphere::Inputs asked = inputs;
    if (!sunlit) asked.geometry.sun_zenith_rad.reset();
    asked.polarized = sunlit;
    if (!sunlit && inputs.geometry.sun_zenith_rad)
      asked.directional = nullptr;  // what the air emits alone is told of it
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

/// The same light over ground that reflects, node by node: ground and air pass light back and forth in each as they absorb there.
class OverGround {
 public:
  OverGround(const SensorAtmosphere& air, const radiometry::Spectrum& ground)
      : air_(air), reflectance_(air.node_count()) {
    air.nodes().average_surface(ground, reflectance_);
    if (air.directional() == nullptr) return;
    const std::vector<double> none(air.node_count(), 0.0);
    const SensorGeometry& geometry = air.geometry();
    // Azimuths there count clockwise.
    straight_ = SkyOverGround(air, none).towards(std::cos(geometry.view_zenith_rad),
                                                 -geometry.view_azimuth_rad - std::numbers::pi);
  }

  void add(std::size_t n, double weight, AtmosphereEffects::OverGround& to) const {
    const SensorAtmosphere::LevelFluxes& level = air_.level_fluxes();
    const DirectionalLight* directional = air_.directional();
    const double sine = air_.geometry().sun_sine(), reflectance = static_cast<double>(reflectance_[n]);
    const double albedo = directional != nullptr ? directional->albedo[n] : air_.spherical_albedo()[n];
    const double down = air_.sun_irradiance()[n] * sine + air_.sky_irradiance()[n];
    const double up = directional != nullptr ? directional->exitance(n, 0.0)
                                             : reflectance * down / (1.0 - reflectance * albedo);
    const double leaving = up / std::numbers::pi;
    to.ground_diffuse += weight * (air_.sky_irradiance()[n] + albedo * up);
    to.ground_up += weight * up;
    to.sensor_direct += weight * level.sun[n] * sine;
    to.sensor_diffuse += weight * (level.down[n] + up * (directional != nullptr ? directional->down[n]
                                                                                : level.ground_down[n]));
    to.sensor_up +=
        weight * (level.up[n] + up * (directional != nullptr ? directional->up[n] : level.ground_up[n]));
    const double through = air_.view_transmittance()[n];
    to.radiance +=
        weight *
        (air_.view_radiance()[n] + through * (directional != nullptr ? straight(0, n) : leaving) +
         leaving * (directional != nullptr ? directional->path_i[n] : air_.diffuse_transmittance()[n]));
    if (!air_.polarized()) return;
    const SensorAtmosphere::LineOfSightPolarization path = air_.line_of_sight_polarization(0);
    to.q += weight * path.q[n];
    to.u += weight * own_side(air_.geometry(), path.u[n]);
    if (directional == nullptr) {
      to.q += weight * leaving * path.diffuse_q[n];
      return;
    }
    to.q += weight * (through * straight(1, n) + leaving * directional->path_q[n]);
    to.u += weight * (through * straight(2, n) + leaving * own_side(air_.geometry(), directional->path_u[n]));
  }

 private:
  double straight(std::size_t component, std::size_t n) const {
    const std::size_t at = component * air_.node_count() + n;
    return straight_.sun[at] + straight_.sky[at];
  }
  const SensorAtmosphere& air_;
  std::vector<float> reflectance_;
  SkyOverGround::Radiance straight_;
};

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
  std::optional<OverGround> by_night;
  if (!geometry.sun_zenith_rad) by_night.emplace(night, part.ground);
  add(night, [&](AtmosphereEffects& to, std::size_t n, double weight) {
    to.thermal_path += weight * night.view_radiance()[n];
    to.thermal_sky += weight * night.sky_irradiance()[n];
    if (by_night) by_night->add(n, weight, to.over_ground);
  });
  if (!geometry.sun_zenith_rad) return;
  const double sine = geometry.sun_sine();
  const SensorAtmosphere day = part.solve(true);
  const OverGround by_day(day, part.ground);
  add(day, [&](AtmosphereEffects& to, std::size_t n, double weight) {
    to.solar_path += weight * day.view_radiance()[n];
    to.solar_sky += weight * day.sky_irradiance()[n];
    to.direct_irradiance += weight * day.sun_irradiance()[n] * sine;
    to.path_q += weight * day.line_of_sight_polarization(0).q[n];
    to.path_u += weight * own_side(geometry, day.line_of_sight_polarization(0).u[n]);
    by_day.add(n, weight, to.over_ground);
  });
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    AtmosphereEffects& of = light[c];
    of.diffuse_transmittance = day.channel_means().diffuse_transmittance[c];
    of.spherical_albedo = day.channel_means().spherical_albedo[c];
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
    Part part{column, some, {}, control.ground};
    part.inputs.channels = some;
    part.inputs.solar_irradiance = solar_irradiance;
    part.inputs.demands.most_nodes = control.most_nodes;
    part.inputs.geometry = geometry;
    if (!control.directional) part.inputs.sky = fewest_directions();
    part.inputs.directional = control.directional;
    if (!control.ground.is_constant()) part.inputs.surfaces = {&control.ground, 1};
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
