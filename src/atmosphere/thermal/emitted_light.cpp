#include "atmosphere/thermal/emitted_light.h"

#include <numbers>
#include <utility>

#include "atmosphere/layer_optics.h"
#include "atmosphere/thermal/thermal_column.h"

namespace ifov::atmosphere {

EmittedLight::EmittedLight(const Levels& levels, const LayerOptics& optics, std::vector<double> planck,
                           const ScatteringOptions& options)
    : altitude_km_(levels.altitude_km), planck_(std::move(planck)), absorption_(optics.gas_absorption) {
  for (std::size_t i = 0; i < absorption_.size(); ++i) absorption_[i] += optics.aerosol_absorption[i];
  if (!scatters_own_light(optics)) return;
  const std::vector<int> parts = ThermalScattering::parts(levels, optics, options);
  solved_.emplace(levels, optics, planck_, parts, options);
  altitude_km_ = solved_->altitude_km();
  planck_ = solved_->planck();
  std::vector<double> cut;
  for (std::size_t layer = 0; layer < parts.size(); ++layer)
    cut.insert(cut.end(), static_cast<std::size_t>(parts[layer]), absorption_[layer] / parts[layer]);
  absorption_ = std::move(cut);
}

ThermalColumn EmittedLight::column() const {
  if (!solved_) return ThermalColumn(altitude_km_, planck_, absorption_);
  return ThermalColumn(altitude_km_, planck_, absorption_, solved_->scattering_depth());
}

std::vector<double> EmittedLight::scattered(double mu) const {
  return solved_ ? solved_->scattered(mu) : std::vector<double>{};
}

double EmittedLight::sky(double mu, double observer_km) const {
  return column().sky(mu, observer_km, scattered(-mu));
}

double EmittedLight::line_of_sight(double observer_km, double mu, double surface_km) const {
  return column().line_of_sight(observer_km, mu, surface_km, scattered(mu)).radiance;
}

double EmittedLight::irradiance(double observer_km) const {
  const GaussNodes hemisphere = gauss_nodes(8);
  double sum = 0.0;
  for (std::size_t j = 0; j < hemisphere.position.size(); ++j)
    sum += 2.0 * std::numbers::pi * hemisphere.weight[j] * hemisphere.position[j] *
           sky(hemisphere.position[j], observer_km);
  return sum;
}

}  // namespace ifov::atmosphere
