#include "atmosphere/particles/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "atmosphere/gauss_nodes.h"

namespace ifov::atmosphere {
namespace {

constexpr int kNodes = 8;              ///< a panel
constexpr double kWidestPanel = 0.16;  ///< of ln r

/// What a sphere scatters at most: r^2, and less as r^4 where it is small against the wavelength over 2 pi.
double log_scattering(double t, double log_wavelength) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  return 2.0 * t + 4.0 * std::min(0.0, t + std::log(kTwoPi) - log_wavelength);
}

using LogNumber = std::function<double(double)>;

/// Gauss's nodes in panels of ln r from end to end, each as wide as `panel_width` says at its beginning.
SizeDistribution by_panels(const LogNumber& log_number, double low, double high,
                           const std::function<double(double)>& panel_width) {
  static const GaussNodes gauss = gauss_nodes(kNodes);
  SizeDistribution sizes;
  for (double t = low; t < high - 1e-12;) {
    double width = std::min(panel_width(t), high - t);
    if (high - t - width < 0.1 * width) width = high - t;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double radius = std::exp(t + width * gauss.position[k]);
      sizes.radius_um.push_back(radius);
      sizes.number.push_back(width * gauss.weight[k] * std::exp(log_number(radius)));
    }
    t += width;
  }
  sizes.log_number = log_number;
  sizes.least_um = std::exp(low), sizes.most_um = std::exp(high);
  return sizes;
}

/// Over what counts: where r^2 dn/dln r is more than 1e-7 of its largest (6e-6 at the large end), and at the large end also what
/// scatters light of 50 um.
SizeDistribution sampled(double about_um, const LogNumber& log_number, RadiusRange range = {}) {
  constexpr double kStep = 0.02, kLeast = -16.0, kLeastAbove = -12.0, kFar = 20.0;
  const double log_longest = std::log(50.0), middle = std::log(about_um);
  const double low = std::max(middle - kFar, std::log(range.least_um)),
               high = std::min(middle + kFar, std::log(range.most_um));
  const auto bounds = [&](const auto& weight) {
    double best = -1e300, at = low;
    for (double t = low; t <= high; t += kStep)
      if (const double here = log_number(std::exp(t)) + weight(t); here > best) best = here, at = t;
    double first = at, last = at;
    while (first > low && log_number(std::exp(first)) + weight(first) > best + kLeast) first -= kStep;
    while (last < high && log_number(std::exp(last)) + weight(last) > best + kLeastAbove) last += kStep;
    return std::pair(std::max(first, low), std::min(last, high));
  };
  const auto [first, of_areas] = bounds([](double t) { return 2.0 * t; });
  const double last =
      std::max(of_areas, bounds([&](double t) { return log_scattering(t, log_longest); }).second);
  return by_panels(log_number, first, last, [](double) { return kWidestPanel; });
}

double moment(const SizeDistribution& sizes, double power) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sizes.radius_um.size(); ++k)
    sum += sizes.number[k] * std::pow(sizes.radius_um[k], power);
  return sum;
}

}  // namespace

double SizeDistribution::effective_radius_um() const { return moment(*this, 3.0) / moment(*this, 2.0); }

double SizeDistribution::effective_variance() const {
  return moment(*this, 4.0) * moment(*this, 2.0) / std::pow(moment(*this, 3.0), 2) - 1.0;
}

double SizeDistribution::share_within() const { return of_all > 0.0 ? moment(*this, 0.0) / of_all : 1.0; }

SizeDistribution SizeDistribution::resolved(double wavelength_um, double most_terms) const {
  if (!log_number) return *this;
  constexpr double kFinest = 0.05, kCoarser = 1.3;
  const double low = std::log(least_um), high = std::log(most_um);
  const double log_wavenumber = std::log(2.0 * std::numbers::pi / wavelength_um);
  double most = -1e300;
  const auto weight = [&](double t) {
    return log_number(std::exp(t)) + log_scattering(t, std::log(wavelength_um));
  };
  for (double t = low; t <= high; t += kWidestPanel) most = std::max(most, weight(t));
  double step = kFinest, lean = 0.5, as_fine_to = std::log(1e4);
  const auto width = [&](double t) {
    const double coarser = lean * std::max(0.0, most - weight(t) - as_fine_to);
    return std::min(kWidestPanel, kNodes * step * std::exp(coarser - t - log_wavenumber));
  };
  const auto terms = [&] {
    double sum = 0.0;
    for (double t = low; t < high; t += kWidestPanel)
      sum += kNodes * kWidestPanel / width(t) * (std::exp(t + log_wavenumber) + 4.0);
    return sum;
  };
  if (terms() > most_terms) {
    lean = 1.0 / 3.0, as_fine_to = 0.0;
    for (double before = 0.0, now = terms(); now > most_terms && now != before; before = now, now = terms())
      step *= kCoarser;
  }
  SizeDistribution finer = by_panels(log_number, low, high, width);
  finer.of_all = of_all;
  return finer;
}

SizeDistribution lognormal(double median_um, double deviation, RadiusRange range) {
  if (!(median_um > 0.0 && deviation > 1.0))
    throw std::invalid_argument(
        "a lognormal distribution has a median above 0 and a geometric deviation above 1");
  const double width = std::log(deviation);
  SizeDistribution sizes = sampled(
      median_um,
      [median_um, width](double radius) {
        const double t = std::log(radius / median_um) / width;
        return -0.5 * t * t;
      },
      range);
  sizes.of_all = std::sqrt(2.0 * std::numbers::pi) * width;
  return sizes;
}

SizeDistribution modified_gamma(double mode_um, double alpha, double gamma) {
  if (!(mode_um > 0.0 && alpha > 0.0 && gamma > 0.0))
    throw std::invalid_argument("a modified gamma distribution has a mode, alpha and gamma above 0");
  return sampled(mode_um, [=](double radius) {
    const double ratio = radius / mode_um;
    return (alpha + 1.0) * std::log(ratio) - alpha / gamma * std::pow(ratio, gamma);
  });
}

SizeDistribution gamma_by_effective_radius(double effective_um, double variance) {
  if (!(effective_um > 0.0 && variance > 0.0 && variance < 1.0 / 3.0))
    throw std::invalid_argument("an effective radius is above 0 and its variance between 0 and 1/3");
  const double alpha = (1.0 - 3.0 * variance) / variance;
  return modified_gamma(alpha * effective_um * variance, alpha, 1.0);
}

}  // namespace ifov::atmosphere
