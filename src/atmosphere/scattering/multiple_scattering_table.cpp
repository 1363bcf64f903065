#include "atmosphere/scattering/multiple_scattering_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "core/parallel.h"

namespace ifov::atmosphere {

namespace {

/// Ratios below this are as good as none.
constexpr double kSmallest = 1e-12;

double stretched(double depth) { return std::log1p(10.0 * depth); }

std::vector<double> mapped(std::vector<double> values, double (*map)(double)) {
  if (values.size() < 2)
    throw std::invalid_argument("a table of multiple scattering needs two nodes along each axis");
  for (double& value : values) value = map(value);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) throw std::invalid_argument("nodes of multiple scattering must rise");
  }
  return values;
}

/// Weights of the nodes `first` .. `first` + count - 1.
struct Interpolation {
  std::size_t first = 0, count = 1;
  std::array<double, 4> weight{1.0, 0.0, 0.0, 0.0};
};

/// Lagrange's polynomial through the `most` nodes nearest to x.
Interpolation lagrange(std::span<const double> nodes, double x, std::size_t most) {
  const std::size_t above =
      static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
  Interpolation result;
  result.count = std::min(most, nodes.size());
  const std::size_t half = result.count / 2;
  result.first = std::min(above > half ? above - half : 0, nodes.size() - result.count);
  for (std::size_t i = 0; i < result.count; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < result.count; ++j) {
      if (j == i) continue;
      weight *= (x - nodes[result.first + j]) / (nodes[result.first + i] - nodes[result.first + j]);
    }
    result.weight[i] = weight;
  }
  return result;
}

Interpolation lagrange_within(std::span<const double> nodes, double x, std::size_t most) {
  return lagrange(nodes, std::clamp(x, nodes.front(), nodes.back()), most);
}

/// Shares of up to three profiles whose mixture has the means of `gas`; a little less than none and more than
/// all is allowed, since pressure puts one gas's bands at somewhat different heights.
std::array<double, 3> shares(std::span<const GasPlacement> profiles, const GasPlacement& gas) {
  if (profiles.size() < 2) return {1.0, 0.0, 0.0};
  const GasPlacement &a = profiles[0], &b = profiles[1];
  const auto bounded = [](double share) { return std::clamp(share, -0.5, 1.5); };
  if (profiles.size() == 2) {
    const double second = bounded((gas.under - a.under) / (b.under - a.under));
    return {1.0 - second, second, 0.0};
  }
  const GasPlacement& c = profiles[2];
  const double b1 = b.under - a.under, c1 = c.under - a.under, g1 = gas.under - a.under;
  const double b2 = b.under_square - a.under_square, c2 = c.under_square - a.under_square,
               g2 = gas.under_square - a.under_square;
  const double determinant = b1 * c2 - c1 * b2;
  const double second = bounded((g1 * c2 - c1 * g2) / determinant);
  const double third = bounded((g1 - second * b1) / c1);
  return {1.0 - second - third, second, third};
}

}  // namespace

GasPlacement gas_placement(const LayerOptics& optics) {
  GasPlacement placement;
  double above = 0.0, square = 0.0, scattered = 0.0;
  for (std::size_t i = optics.layers(); i-- > 0;) {
    const double s = optics.rayleigh_scattering[i] + optics.aerosol_scattering[i];
    placement.depth += optics.gas_absorption[i];
    // Means over a layer through which the share grows linearly.
    above += optics.gas_absorption[i] * (scattered + 0.5 * s);
    square += optics.gas_absorption[i] * (scattered * (scattered + s) + s * s / 3.0);
    scattered += s;
  }
  if (placement.depth > 0.0 && scattered > 0.0) {
    placement.under = above / (placement.depth * scattered);
    placement.under_square = square / (placement.depth * scattered * scattered);
  }
  return placement;
}

MultipleScatteringTable::MultipleScatteringTable(const Nodes& nodes, const MakeOptics& optics,
                                                 const Solve& solve, int threads)
    : log_wavelength_(mapped(nodes.wavelength_um, [](double value) { return std::log(value); })),
      depth_(mapped(nodes.depth, stretched)),
      profiles_(nodes.profiles) {
  if (nodes.depth.front() != 0.0 || profiles_ < 1 || profiles_ > 3) {
    throw std::invalid_argument(
        "a table of multiple scattering starts without gas and has one to three profiles");
  }
  placement_.resize(log_wavelength_.size() * profiles_);
  std::vector<std::vector<Entry>> rows(log_wavelength_.size() * depth_.size() * profiles_);
  parallel_for(static_cast<std::int64_t>(rows.size()), threads, [&](std::int64_t index) {
    const std::size_t at = static_cast<std::size_t>(index), profile = at % profiles_;
    const std::size_t depth = at / profiles_ % depth_.size(), wavelength = at / profiles_ / depth_.size();
    // Without gas all profiles are one.
    if (depth == 0 && profile > 0) return;
    const double wavelength_um = nodes.wavelength_um[wavelength];
    const LayerOptics column = optics(wavelength_um, nodes.depth[depth], profile);
    for (const LightByOrder& light : solve(wavelength_um, column)) {
      Entry entry;
      const double ratio = light.first.i > 0.0 ? light.rest.i / light.first.i : 0.0;
      entry.log_ratio = std::log(std::max(ratio, kSmallest));
      if (light.rest.i > 0.0) {
        entry.q = light.rest.q / light.rest.i;
        entry.u = light.rest.u / light.rest.i;
      }
      rows[at].push_back(entry);
    }
    if (depth == 1) placement_[wavelength * profiles_ + profile] = gas_placement(column);
  });
  quantities_ = rows.front().size();
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const bool without_gas = at / profiles_ % depth_.size() == 0;
    const std::vector<Entry>& entries = rows[without_gas ? at - at % profiles_ : at];
    if (entries.size() != quantities_) {
      throw std::invalid_argument("every solution must have the same number of quantities");
    }
    entries_.insert(entries_.end(), entries.begin(), entries.end());
  }
  for (std::size_t i = 0; i < placement_.size(); ++i) {
    if (i % profiles_ > 0 && !(placement_[i].under > placement_[i - 1].under)) {
      throw std::invalid_argument("profiles of gas must come from the highest to the lowest");
    }
  }
}

void MultipleScatteringTable::complete(double wavelength_um, const GasPlacement& gas,
                                       std::span<const StokesVector> first,
                                       std::span<StokesVector> total) const {
  if (first.size() != quantities_ || total.size() != quantities_) {
    throw std::invalid_argument("as many quantities are completed as were solved");
  }
  const Interpolation along = lagrange_within(log_wavelength_, std::log(wavelength_um), 2);
  const Interpolation across = lagrange_within(depth_, stretched(gas.depth), 4);
  std::vector<Entry> mean(quantities_);
  for (std::size_t w = 0; w < along.count; ++w) {
    const std::size_t wavelength = along.first + w;
    const std::array<double, 3> mixture =
        shares(std::span(placement_).subspan(wavelength * profiles_, profiles_), gas);
    for (std::size_t a = 0; a < across.count; ++a) {
      for (std::size_t p = 0; p < profiles_; ++p) {
        const double weight = along.weight[w] * across.weight[a] * mixture[p];
        const Entry* entry = entries_.data() + row(wavelength, across.first + a, p) * quantities_;
        for (std::size_t k = 0; k < quantities_; ++k) {
          mean[k].log_ratio += weight * entry[k].log_ratio;
          mean[k].q += weight * entry[k].q;
          mean[k].u += weight * entry[k].u;
        }
      }
    }
  }
  for (std::size_t k = 0; k < quantities_; ++k) {
    const double rest = first[k].i * std::exp(mean[k].log_ratio);
    total[k] = first[k] + StokesVector{rest, rest * mean[k].q, rest * mean[k].u};
  }
}

}  // namespace ifov::atmosphere
