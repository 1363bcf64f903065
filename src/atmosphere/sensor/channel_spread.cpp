#include "atmosphere/sensor/channel_spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "core/parallel.h"
#include "radiometry/channel.h"

namespace ifov::atmosphere {
namespace {

constexpr std::size_t kAllPhotons = std::size_t{1} << 18, kLeastPhotons = 4096, kMostPhotons = 16384;

/// One set of layers that stands for all terms.
LayerOptics mean_layers(const ColumnOptics& optics) {
  LayerOptics mean = optics.scattering;
  mean.gas_absorption.assign(optics.continuum.size(), 0.0);
  double sum = 0.0;
  for (std::size_t term = 0; term < optics.terms(); ++term) {
    const LayerOptics layers = optics.term(term);
    const double depth = std::accumulate(layers.gas_absorption.begin(), layers.gas_absorption.end(), 0.0);
    const double weight = optics.weight(term) * std::exp(-2.0 * depth);  // as it is seen: down and up again
    sum += weight;
    for (std::size_t k = 0; k < mean.gas_absorption.size(); ++k)
      mean.gas_absorption[k] += weight * layers.gas_absorption[k];
  }
  for (double& depth : mean.gas_absorption) depth = sum > 0.0 ? depth / sum : 0.0;
  return mean;
}

}  // namespace

std::vector<ChannelSpread> channel_spreads(const AtmosphereColumn& column,
                                           std::span<const radiometry::Channel> channels,
                                           const SensorGeometry& geometry, int threads) {
  const std::size_t photons =
      std::clamp(kAllPhotons / std::max<std::size_t>(1, channels.size()), kLeastPhotons, kMostPhotons);
  std::vector<std::optional<ChannelSpread>> found(channels.size());
  parallel_for(static_cast<std::int64_t>(channels.size()), threads, [&](std::int64_t c) {
    const std::size_t k = static_cast<std::size_t>(c);
    constexpr double kCm1_um = 1e4;
    const LayerOptics layers = mean_layers(column.at(kCm1_um / channels[k].centre_um));
    const std::vector<double>& altitude_km = column.levels().altitude_km;
    const GroundSpread::Sight seen{geometry.view_zenith_rad, geometry.sensor_altitude_km},
        back{0.0, 0.0, true};
    found[k].emplace(
        ChannelSpread{{altitude_km, layers, seen, photons}, {altitude_km, layers, back, photons}});
  });
  std::vector<ChannelSpread> all;
  for (std::optional<ChannelSpread>& one : found) all.push_back(std::move(*one));
  return all;
}

}  // namespace ifov::atmosphere
