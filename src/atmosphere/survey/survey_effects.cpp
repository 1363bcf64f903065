#include "atmosphere/survey/survey_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
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

  SensorAtmosphere solve(bool sunlit) const {
    SensorAtmosphere::Inputs asked = inputs;
    if (!sunlit) asked.geometry.sun_zenith_rad.reset();
    return SensorAtmosphere(column, asked);
  }
};

/// What is left of all light without the part; 0 where that is rounding.
double rest(double all, double part) { return all > part * (1.0 + 1e-12) ? all - part : 0.0; }

void survey_part(const Part& part, AtmosphereEffects* light) {
  std::vector<std::vector<ChannelBin>> bins;
  for (const radiometry::Channel& channel : part.channels)
    bins.push_back(channel_bins(channel, part.inputs.solar_irradiance));
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
  });
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    AtmosphereEffects& of = light[c];
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
    Part part{column, some, {}};
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

std::vector<radiometry::Channel> resolved_steps(double first_um, double last_um, std::size_t most) {
  const double low = 1e4 / last_um, high = 1e4 / first_um;
  double step = kResolution_cm1;
  step *= std::max(1.0, std::ceil((high - low) / (step * static_cast<double>(most))));
  std::vector<radiometry::Channel> channels;
  for (double from = std::floor(low / step) * step; from < high; from += step)
    channels.push_back(radiometry::Channel::top_hat(format("{:g} cm-1", from + 0.5 * step),
                                                    1e4 / (from + step), 1e4 / from));
  std::reverse(channels.begin(), channels.end());
  return channels;
}

}  // namespace ifov::atmosphere
