#include "atmosphere/sensor/finer_atmosphere.h"

#include <algorithm>

namespace ifov::atmosphere {
namespace {

ColumnOptions finer_than(const AtmosphereColumn& column) {
  ColumnOptions options;
  options.terms = 8;
  options.most_terms = 16;
  options.most_warm_terms = 32;
  const std::vector<double>& altitude = column.levels().altitude_km;
  for (std::size_t i = 0; i < altitude.size(); ++i) {
    options.extra_altitudes_km.push_back(altitude[i]);
    if (i + 1 < altitude.size()) options.extra_altitudes_km.push_back(0.5 * (altitude[i] + altitude[i + 1]));
  }
  return options;
}

}  // namespace

FinerAtmosphere::FinerAtmosphere(const AtmosphereColumn& judged)
    : judged_(judged), column_(judged.description(), finer_than(judged)) {}

LayerOptics FinerAtmosphere::cut(const LayerOptics& layers, double wavenumber_cm1) const {
  const ColumnOptics here = column_.at(wavenumber_cm1);
  const std::vector<double>&altitude = column_.levels().altitude_km, &bounds = judged_.levels().altitude_km;
  std::vector<double> gas = here.continuum;
  for (std::size_t t = 0; t < here.terms(); ++t)
    for (std::size_t l = 0; l < gas.size(); ++l) gas[l] += here.weight(t) * here.lines.depth[t][l];
  LayerOptics cut = here.scattering;
  cut.gas_absorption.assign(gas.size(), 0.0);
  for (std::size_t l = 0, first = 0; l < layers.layers(); ++l) {
    std::size_t last = first;
    double all = 0.0;
    for (; last < gas.size() && altitude[last] < bounds[l + 1]; ++last) all += gas[last];
    for (std::size_t k = first; k < last; ++k) {
      const double thickness = (altitude[k + 1] - altitude[k]) / (bounds[l + 1] - bounds[l]);
      cut.gas_absorption[k] = layers.gas_absorption[l] * (all > 0.0 ? gas[k] / all : thickness);
    }
    first = last;
  }
  return cut;
}

ScatteringOptions FinerAtmosphere::finer(ScatteringOptions options) {
  constexpr int kMostNodes = 24;
  options.nodes_per_hemisphere = std::min(kMostNodes, options.nodes_per_hemisphere * 3 / 2);
  options.polarized = true;
  options.sublayer_depth *= 0.5;
  options.tolerance *= 0.1;
  return options;
}

}  // namespace ifov::atmosphere
