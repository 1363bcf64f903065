#include "radiometry/channel_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "radiometry/gauss_legendre.h"
#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr double kIntervals = 128.0;   // of the whole range, at least
constexpr double kWidestShare = 0.03;  // of a step, of its wavelength
/// Relative error of a surface's mean from which on its own points are taken in; and the mean below which it is
/// relative to this.
constexpr double kUnresolved = 5e-5, kDarkSurface = 1e-2;
// So dark that no sensor sees it, but keeps the reference from vanishing where there is neither Sun nor heat.
constexpr double kDarkest_w_m2_sr_um = 1e-6;
/// Radiance that is hidden altogether counts this much still: it lights what is seen.
constexpr double kLeastSeen = 1e-3;

double reference_radiance(double wavelength_um, double irradiance) {
  return irradiance / std::numbers::pi + planck_w_m2_sr_um(wavelength_um, 300.0) + kDarkest_w_m2_sr_um;
}

}  // namespace

std::vector<double> integration_steps_um(const std::vector<double>& points_um) {
  const double first = points_um.front(), last = points_um.back();
  const double widest = (last - first) / kIntervals;
  std::vector<double> coarse = points_um;
  if (kWidestShare * first < widest) {
    for (double x = first; kWidestShare * x < widest && x < last; x *= 1.0 + kWidestShare)
      coarse.push_back(x);
    std::sort(coarse.begin(), coarse.end());
    coarse.erase(std::unique(coarse.begin(), coarse.end()), coarse.end());
  }
  std::vector<double> steps{coarse.front()};
  for (std::size_t i = 0; i + 1 < coarse.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil((coarse[i + 1] - coarse[i]) / (last - first) * kIntervals)));
    const double width = (coarse[i + 1] - coarse[i]) / parts;
    for (int part = 1; part < parts; ++part) steps.push_back(coarse[i] + part * width);
    steps.push_back(coarse[i + 1]);
  }
  return steps;
}

void ChannelGrid::place_points(const Channel& channel, std::span<const Spectrum* const> spectra) {
  wavelength_um.clear();
  response.clear();
  const std::vector<double> steps = integration_steps_um(
      merged_wavelengths_um(spectra, channel.response.first_um(), channel.response.last_um()));
  double total = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    for (const GaussPoint& gauss : kGauss2) {
      const double x = steps[i] + gauss.position * (steps[i + 1] - steps[i]);
      const double weight = gauss.weight * (steps[i + 1] - steps[i]) * channel.response.at(x);
      if (weight == 0.0) continue;
      wavelength_um.push_back(x);
      response.push_back(weight);
      total += weight;
    }
  for (double& weight : response) weight /= total;
}

/// Whether sums over the points are the integrals of the light that the surface reflects once and twice.
bool ChannelGrid::resolves(const Channel& channel, const Spectrum& light, const Spectrum& surface) const {
  const double first = channel.response.first_um(), last = channel.response.last_um();
  const std::vector<double> at_points = sampled(surface), lit = sampled(light);
  const Spectrum* factors[] = {&channel.response, &light, &surface, &surface};
  const double whole = integral_of_product(std::span(factors).first(1), first, last);
  double sum[3] = {};
  for (std::size_t q = 0; q < size(); ++q) {
    double value = response[q] * lit[q];
    for (double& power : sum) {
      power += value;
      value *= at_points[q];
    }
  }
  for (std::size_t powers = 1; powers <= 2; ++powers) {
    const double exact = integral_of_product(std::span(factors).first(2 + powers), first, last) / whole;
    if (std::abs(sum[powers] - exact) > kUnresolved * std::max(exact, kDarkSurface * sum[0])) return false;
  }
  return true;
}

ChannelGrid::ChannelGrid(const Channel& channel, const Spectrum& solar_irradiance,
                         std::span<const Spectrum> surfaces, const Spectrum* sky_radiance,
                         std::span<const Spectrum> lamps) {
  if (channel.is_monochromatic()) {
    wavelength_um = {channel.centre_um};
    response = {1.0};
  } else {
    std::vector<const Spectrum*> spectra{&channel.response, &solar_irradiance};
    if (sky_radiance != nullptr) spectra.push_back(sky_radiance);
    for (const Spectrum& lamp : lamps) spectra.push_back(&lamp);
    place_points(channel, spectra);
    const std::size_t lights = spectra.size();
    const Spectrum even = Spectrum::constant(1.0);
    for (const Spectrum& surface : surfaces)
      if (!surface.is_constant() &&
          !(resolves(channel, even, surface) && resolves(channel, solar_irradiance, surface) &&
            (sky_radiance == nullptr || resolves(channel, *sky_radiance, surface)) &&
            std::all_of(lamps.begin(), lamps.end(),
                        [&](const Spectrum& lamp) { return resolves(channel, lamp, surface); })))
        spectra.push_back(&surface);
    if (spectra.size() > lights) place_points(channel, spectra);
  }
  irradiance = sampled(solar_irradiance);
  if (sky_radiance != nullptr) {
    sky = sampled(*sky_radiance);
    for (std::size_t q = 0; q < size(); ++q) irradiance[q] += sky[q] *= std::numbers::pi;
  }
  for (std::size_t q = 0; q < size(); ++q)
    bright.push_back(reference_radiance(wavelength_um[q], irradiance[q]));
  reference = bright;
}

ChannelGrid::ChannelGrid(std::vector<double> wavelengths_um, std::vector<double> shares,
                         std::vector<double> irradiances, std::vector<double> skies,
                         std::vector<double> transmittances, double least)
    : wavelength_um(std::move(wavelengths_um)),
      response(std::move(shares)),
      irradiance(std::move(irradiances)),
      sky(std::move(skies)),
      least_radiance(least),
      seen(std::move(transmittances)) {
  const double total = std::accumulate(response.begin(), response.end(), 0.0);
  for (double& weight : response) weight /= total;
  for (std::size_t q = 0; q < size(); ++q) {
    bright.push_back(reference_radiance(wavelength_um[q], irradiance[q]));
    reference.push_back(std::max(kLeastSeen, seen[q]) * bright[q]);
  }
}

std::vector<double> ChannelGrid::sampled(const Spectrum& spectrum) const {
  std::vector<double> values(size());
  for (std::size_t q = 0; q < size(); ++q) values[q] = spectrum.at(wavelength_um[q]);
  return values;
}

}  // namespace ifov::radiometry
