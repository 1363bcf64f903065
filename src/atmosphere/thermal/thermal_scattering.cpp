#include "atmosphere/thermal/thermal_scattering.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/column_phase.h"
#include "atmosphere/scattering/phase/spherical_functions.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/successive_orders.h"

namespace ifov::atmosphere {
namespace {

constexpr double kLeastDepth = 5e-4;
/// Sublayers may scatter this much more than the options say for sunlight.
constexpr double kCoarser = 2.0;

ScatteringColumn flat_column(const Levels& levels, const LayerOptics& optics, ScatteringOptions options,
                             std::span<const int> parts) {
  options.spherical_earth = false;  // of the sunbeam, of which there is none
  return ScatteringColumn(levels, optics, 0.0, options, parts);
}

}  // namespace

bool scatters_own_light(const LayerOptics& optics) {
  const auto sum = [](const std::vector<double>& depth) {
    return std::accumulate(depth.begin(), depth.end(), 0.0);
  };
  return sum(optics.rayleigh_scattering) + sum(optics.aerosol_scattering) >= kLeastDepth;
}

std::vector<int> ThermalScattering::parts(const Levels& levels, const LayerOptics& optics,
                                          const ScatteringOptions& options) {
  const std::vector<int> whole(optics.layers(), 1);
  const ScatteringColumn column = flat_column(levels, optics, options, whole);
  std::vector<int> parts;
  for (std::size_t s = column.sublayers(); s-- > 0;) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[s]];
    const double scattered = column.depth[s] * (mixture.rayleigh + mixture.aerosol * (1.0 - mixture.peak));
    parts.push_back(static_cast<int>(std::clamp(std::ceil(scattered / (kCoarser * options.sublayer_depth)),
                                                1.0, static_cast<double>(options.most_sublayers))));
  }
  return parts;
}

ThermalScattering::ThermalScattering(const Levels& levels, const LayerOptics& optics,
                                     std::span<const double> planck, std::span<const int> parts,
                                     const ScatteringOptions& options) {
  ScatteringOptions scalar = options;
  scalar.polarized = false;
  const ScatteringColumn column = flat_column(levels, optics, scalar, parts);
  const ColumnPhase phase(column, AerosolProjection(2 * scalar.nodes_per_hemisphere, 0.0),
                          2 * scalar.nodes_per_hemisphere);
  const std::size_t n = column.sublayers();
  altitude_km_.assign(column.altitude_km.rbegin(), column.altitude_km.rend());
  for (std::size_t layer = 0; layer < parts.size(); ++layer)
    for (int part = 0; part < parts[layer]; ++part) {
      const double share = static_cast<double>(part) / parts[layer];
      planck_.push_back(planck[layer] * (1.0 - share) + planck[layer + 1] * share);
    }
  planck_.push_back(planck.back());
  const std::vector<double> falling(planck_.rbegin(), planck_.rend());
  const GaussNodes nodes = gauss_nodes(scalar.nodes_per_hemisphere);
  const SuccessiveOrders orders(column, phase, nodes, scalar);
  const ModeMoments moments = orders.emitted(falling).moments;
  terms_ = moments.terms;
  for (std::size_t s = n; s-- > 0;) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[s]];
    scattering_depth_.push_back(column.depth[s] *
                                (mixture.rayleigh + mixture.aerosol * (1.0 - mixture.peak)));
  }
  for (int l = 0; l < terms_; ++l)
    for (std::size_t s = n; s-- > 0;) {
      const double factor = phase.at(phase.beta, l)[s] * column.depth[s];
      moments_.push_back(factor * moments.at(l, 0)[s + 1]);
      moments_.push_back(factor * moments.at(l, 0)[s]);
    }
}

std::vector<double> ThermalScattering::scattered(double mu) const {
  const SphericalFunctions f = spherical_functions(0, terms_, mu);
  const std::size_t ends = 2 * scattering_depth_.size();
  std::vector<double> sum(ends, 0.0);
  for (int l = 0; l < terms_; ++l)
    add_scaled(ends, f.p[l], moments_.data() + static_cast<std::size_t>(l) * ends, sum.data());
  return sum;
}

}  // namespace ifov::atmosphere
