#include "atmosphere/scattering/shell_means.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {
namespace {

constexpr int kDirections = 8;  // in each hemisphere, closer towards the horizontal
constexpr double kMeansApart = 0.1, kStepsOfMeans = 30.0;  // of scattering, between altitudes; of all of it
constexpr double kMeansAtEdge = 0.02;  // from edges on, where light from beyond their horizon arrives
constexpr double kMeansApart_km = 0.75;
constexpr int kMostOrdersOfMeans = 60;
constexpr double kLeastOrder = 1e-3;

double between_falling(const std::vector<double>& falling, const std::vector<double>& values, double at) {
  const auto below = std::lower_bound(falling.begin() + 1, falling.end() - 1, at, std::greater<>());
  const std::size_t k = static_cast<std::size_t>(below - falling.begin()) - 1;
  const double share = std::clamp((falling[k] - at) / (falling[k] - falling[k + 1]), 0.0, 1.0);
  return (1.0 - share) * values[k] + share * values[k + 1];
}

}  // namespace

ShellMeans::ShellMeans(const ScatteringColumn& column) : boundary_km_(column.altitude_km) {
  const std::size_t sublayers = column.sublayers();
  std::vector<double> even(sublayers), shares(sublayers);  // extinction without what goes on; albedo
  std::vector<double> left(sublayers + 1, 0.0);            // scattering depth down to the layer's end
  double all = 0.0;
  for (std::size_t s = sublayers; s-- > 0;) {
    const ScatteringColumn::Mixture& of = column.mixtures[column.mixture_of[s]];
    const double aerosol = of.aerosol * (1.0 - of.peak), on = aerosol * std::max(0.0, of.first);
    even[s] = column.depth[s] * (1.0 - on);
    shares[s] = column.depth[s] * (of.rayleigh + aerosol - on);
    const bool ends = s + 1 == sublayers || column.mixture_of[s + 1] != column.mixture_of[s];
    left[s] = shares[s] + (ends ? 0.0 : left[s + 1]);
    all += shares[s];
  }
  const double most = std::max(kMeansApart, all / kStepsOfMeans);
  altitude_km_.push_back(boundary_km_.front());
  double depth = 0.0, scattered = 0.0;
  for (std::size_t s = 0; s < sublayers; ++s) {
    depth += even[s];
    scattered += shares[s];
    const bool ends = s + 1 == sublayers || column.mixture_of[s + 1] != column.mixture_of[s];
    const double thick = altitude_km_.back() - boundary_km_[s + 1];
    if (!ends && scattered < std::clamp(0.5 * left[s + 1], kMeansAtEdge, most) && thick < kMeansApart_km)
      continue;
    altitude_km_.push_back(boundary_km_[s + 1]);
    extinction_km_.push_back(depth / thick);
    albedo_.push_back(depth > 0.0 ? scattered / depth : 0.0);
    depth = scattered = 0.0;
  }
  for (const Geometry geometry : {kRound, kFlat}) kernel_[geometry] = kernel(geometry);
}

ShellMeans::Kernel ShellMeans::kernel(Geometry geometry) const {
  static const GaussNodes nodes = gauss_nodes(kDirections);
  const std::size_t count = altitude_km_.size();
  Kernel kernel(count, std::vector<double>(count, 0.0));
  for (std::size_t at = 0; at < count; ++at)
    for (std::size_t j = 0; j < nodes.position.size(); ++j)
      for (const double side : {1.0, -1.0}) {
        // Squares: air is brightest towards the horizontal.
        const double root = nodes.position[j], weight = nodes.weight[j] * root;
        const std::vector<double> ray = weights(at, side * root * root, geometry);
        for (std::size_t k = 0; k < count; ++k) kernel[at][k] += weight * ray[k];
      }
  return kernel;
}

/// Of light that arrives at altitude `at` from where mu is the cosine with the vertical upwards: from the ground nothing is scattered.
std::vector<double> ShellMeans::weights(std::size_t at, double mu, Geometry geometry) const {
  const std::size_t layers = extinction_km_.size();
  std::vector<double> sum(layers + 1, 0.0);
  double transmission = 1.0;
  const auto pass = [&](std::size_t layer, std::size_t from, std::size_t to, double length) {
    const LinearSource step = LinearSource::over(extinction_km_[layer] * length);
    const double share = albedo_[layer];
    sum[from] += transmission * step.near * share;
    sum[to] += transmission * step.far * share;
    transmission *= step.transmission;
  };
  const double radius = kEarthRadius_km + altitude_km_[at],
               nearest = radius * std::sqrt(std::max(0.0, 1.0 - mu * mu));
  const auto length = [&](std::size_t layer) {
    if (geometry == kFlat) return (altitude_km_[layer] - altitude_km_[layer + 1]) / std::abs(mu);
    return half_chord_km(kEarthRadius_km + altitude_km_[layer], nearest) -
           half_chord_km(kEarthRadius_km + altitude_km_[layer + 1], nearest);
  };
  std::size_t from = at;
  if (mu < 0.0) {
    // Down to the ground, or to the lowest layer that the line enters and leaves again.
    for (; from < layers; ++from) {
      if (geometry == kRound && kEarthRadius_km + altitude_km_[from + 1] < nearest) {
        // It turns within the layer.
        pass(from, from, from, 2.0 * half_chord_km(kEarthRadius_km + altitude_km_[from], nearest));
        break;
      }
      pass(from, from, from + 1, length(from));
    }
    if (from == layers) return sum;
  }
  for (; from > 0; --from) pass(from - 1, from, from - 1, length(from - 1));
  return sum;
}

std::vector<double> ShellMeans::arriving(const std::vector<double>& source, const Kernel& kernel) {
  std::vector<double> result(source.size(), 0.0);
  for (std::size_t at = 0; at < source.size(); ++at)
    for (std::size_t k = 0; k < source.size(); ++k) result[at] += kernel[at][k] * source[k];
  return result;
}

std::vector<double> ShellMeans::at_altitudes(std::span<const double> values) const {
  const std::vector<double> given(values.begin(), values.end());
  std::vector<double> result;
  for (const double altitude : altitude_km_) result.push_back(between_falling(boundary_km_, given, altitude));
  return result;
}

std::vector<double> ShellMeans::ratio(const std::vector<double>& round,
                                      const std::vector<double>& flat) const {
  std::vector<double> ratio(altitude_km_.size(), 1.0), result;
  for (std::size_t k = 0; k < ratio.size(); ++k)
    if (flat[k] > 0.0) ratio[k] = round[k] / flat[k];
  for (const double altitude : boundary_km_) result.push_back(between_falling(altitude_km_, ratio, altitude));
  return result;
}

std::vector<double> ShellMeans::ratio_of_scattered(std::span<const double> unscattered) const {
  std::array<std::vector<double>, 2> all;
  for (const Geometry geometry : {kRound, kFlat}) {
    std::vector<double> light = at_altitudes(unscattered);
    std::vector<double>& sum = all[geometry];
    sum.assign(light.size(), 0.0);
    double before = 0.0;
    for (int order = 1; order <= kMostOrdersOfMeans; ++order) {
      light = arriving(light, kernel_[geometry]);
      const double most = *std::max_element(light.begin(), light.end()),
                   most_of_sum = *std::max_element(sum.begin(), sum.end());
      const bool last = order == kMostOrdersOfMeans || most <= kLeastOrder * most_of_sum;
      const double further = last && before > 0.0 ? 1.0 / (1.0 - std::min(0.99, most / before)) : 1.0;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += further * light[k];
      if (last) break;
      before = most;
    }
  }
  return ratio(all[kRound], all[kFlat]);
}

}  // namespace ifov::atmosphere
