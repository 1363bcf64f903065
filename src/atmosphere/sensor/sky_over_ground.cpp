#include "atmosphere/sensor/sky_over_ground.h"

#include <cmath>
#include <numbers>

#include "atmosphere/scattering/ground/directional_ground.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/stokes.h"

namespace ifov::atmosphere {
namespace {

constexpr double kGauss2[] = {0.21132486540518712, 0.78867513459481288};

}  // namespace

SkyOverGround::SkyOverGround(const SensorAtmosphere& air, std::span<const double> emitted)
    : air_(air), components_(air.polarized() ? 3 : 1) {
  const DirectionalLight& ground = *air.directional();
  const std::vector<double>&zenith = air.sky_directions().zenith_rad,
        &azimuth = air.sky_directions().azimuth_rad;
  const std::size_t nodes = air.node_count();
  std::vector<double> exitance(nodes);
  for (std::size_t n = 0; n < nodes; ++n) exitance[n] = ground.exitance(n, emitted[n]);
  double whole = 0.0;
  std::vector<double> weights;
  struct Place {
    std::size_t z, a;
    double above;
  };
  std::vector<Place> places;
  // The last is held down to the horizon, where rough ground is as bright as a mirror.
  for (std::size_t z = 0; z < zenith.size(); ++z)
    for (const double above : kGauss2)
      for (std::size_t a = 0; a + 1 < azimuth.size(); ++a) {
        const bool last = z + 1 == zenith.size();
        const double width = (last ? 0.5 * std::numbers::pi : zenith[z + 1]) - zenith[z],
                     angle = zenith[z] + above * width;
        const double weight = 0.5 * width * std::sin(angle) * std::cos(angle) * (azimuth[a + 1] - azimuth[a]);
        for (const double side : {1.0, -1.0}) {
          directions_.push_back({std::cos(angle), side * 0.5 * (azimuth[a] + azimuth[a + 1])});
          places.push_back(last ? Place{z - 1, a, 1.0} : Place{z, a, above});
          weights.push_back(weight);
          whole += weight;
        }
      }
  light_.resize(directions_.size() * components_ * nodes);
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Place& place = places[k];
    const double weight = weights[k] * std::numbers::pi / whole;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t z = place.z + corner / 2, a = place.a + corner % 2;
      const double part = weight * (corner / 2 == 1 ? place.above : 1.0 - place.above) * 0.5;
      const std::size_t row = (z * azimuth.size() + a) * nodes;
      for (std::size_t n = 0; n < nodes; ++n) {
        const double back = exitance[n] / std::numbers::pi;
        float* to = light_.data() + k * components_ * nodes + n;
        if (components_ == 1) {
          to[0] += static_cast<float>(part * (air.sky(z, a, n) + back * ground.sky_i[row + n] +
                                              emitted[n] * air.groundlit_sky(z, n)));
          continue;
        }
        const radiometry::StokesVector sky =
            air.sky_stokes(z, a, n) + emitted[n] * air.groundlit_sky_stokes(z, n);
        const double side = directions_[k].azimuth_rad < 0.0 ? -1.0 : 1.0;
        to[0] += static_cast<float>(part * (sky.i + back * ground.sky_i[row + n]));
        to[nodes] += static_cast<float>(part * (sky.q + back * ground.sky_q[row + n]));
        to[2 * nodes] += static_cast<float>(part * side * (sky.u + back * ground.sky_u[row + n]));
      }
    }
  }
  // As bright on level ground as the air says.
  for (std::size_t n = 0; n < nodes; ++n) {
    const double wanted = air.sky_irradiance()[n] + exitance[n] * ground.albedo[n] +
                          std::numbers::pi * emitted[n] * air.spherical_albedo()[n];
    double sum = 0.0;
    for (std::size_t k = 0; k < directions_.size(); ++k)
      sum += static_cast<double>(light_[k * components_ * nodes + n]);
    const float scale = sum > 0.0 ? static_cast<float>(wanted / sum) : 1.0f;
    for (std::size_t k = n; k < light_.size(); k += nodes) light_[k] *= scale;
  }
}

SkyOverGround::Radiance SkyOverGround::towards(double mu, double azimuth_rad) const {
  const std::size_t values = components_ * air_.node_count();
  Radiance light{std::vector<double>(values, 0.0), std::vector<double>(values, 0.0)};
  add_sky(mu, azimuth_rad, light.sky);
  const double sine = air_.geometry().sun_sine();
  if (!(sine > 0.0)) return light;
  std::vector<double> incoming(values, 0.0);
  for (std::size_t n = 0; n < air_.node_count(); ++n) incoming[n] = air_.sun_irradiance()[n] * sine;
  air_.directional()->ground->add_reflected({mu, -sine, azimuth_rad, 0.0}, incoming, light.sun);
  return light;
}

void SkyOverGround::add_sky(double mu, double azimuth_rad, std::span<double> light) const {
  std::vector<double> incoming(components_ * air_.node_count());
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const float* from = light_.data() + k * incoming.size();
    for (std::size_t i = 0; i < incoming.size(); ++i) incoming[i] = static_cast<double>(from[i]);
    air_.directional()->ground->add_reflected(
        {mu, -directions_[k].mu, azimuth_rad, directions_[k].azimuth_rad}, incoming, light);
  }
}

}  // namespace ifov::atmosphere
