#include "session/assembly/atmosphere/node_tolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/planck.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "scene/scene.h"

namespace ifov::session {
namespace {

constexpr double kLeastTolerance = 2e-5;
constexpr double kWarm_k = 300.0;

/// What is asked for as a share of a radiance, in one channel.
double relative(const scene::Scene& scene, const radiometry::Channel& channel,
                const render::AccuracyRequest& request, std::size_t c) {
  const scene::TemperatureRange emitted = scene.temperatures().value_or(scene::TemperatureRange{});
  const double hottest_k = std::max(kWarm_k, emitted.hottest_k);
  const double warm = radiometry::channel_planck_w_m2_sr_um(channel, hottest_k);
  const double sunlit = scene.sun ? radiometry::channel_mean(channel, scene.sun->irradiance) : 0.0;
  const double white = sunlit / std::numbers::pi + warm;
  switch (request.unit) {
    case render::ErrorUnit::percent:
    case render::ErrorUnit::polarization:
    case render::ErrorUnit::reflectance: return request.error;
    case render::ErrorUnit::kelvin:
      return request.error * radiometry::channel_planck_slope_w_m2_sr_um_k(channel, hottest_k) / warm;
    case render::ErrorUnit::radiance: return request.error / white;
    case render::ErrorUnit::noise: return request.error * request.noise_w_m2_sr_um[c] / white;
  }
  return 1.0;
}

}  // namespace

double node_tolerance(const scene::Scene& scene, std::span<const radiometry::Channel> channels,
                      const render::AccuracyRequest* asked, double share, double usual) {
  if (asked == nullptr) return usual;
  const render::AccuracyRequest& request = *asked;
  double least = usual;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const bool judged = request.channels.empty() ||
                        std::find(request.channels.begin(), request.channels.end(), static_cast<int>(c)) !=
                            request.channels.end();
    if (judged) least = std::min(least, share * relative(scene, channels[c], request, c));
  }
  return std::max(least, kLeastTolerance);
}

}  // namespace ifov::session
