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

// Fine enough that a kink between two points of the grid does not matter; and so dark that no sensor sees it,
// but keeps the reference from vanishing where there is neither Sun nor heat.
constexpr double kIntervals = 128.0;
constexpr double kDarkest_w_m2_sr_um = 1e-6;
/// Radiance that is hidden altogether counts this much still: it lights what is seen.
constexpr double kLeastSeen = 1e-3;

double reference_radiance(double wavelength_um, double irradiance) {
  return irradiance / std::numbers::pi + planck_w_m2_sr_um(wavelength_um, 300.0) + kDarkest_w_m2_sr_um;
}

}  // namespace

ChannelGrid::ChannelGrid(const Channel& channel, const Spectrum& solar_irradiance) {
  if (channel.is_monochromatic()) {
    wavelength_um = {channel.centre_um};
    response = {1.0};
  } else {
    const Spectrum* spectra[] = {&channel.response, &solar_irradiance};
    const double first = channel.response.first_um(), last = channel.response.last_um();
    const std::vector<double> ends = merged_wavelengths_um(spectra, first, last);
    double total = 0.0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const int parts = static_cast<int>(std::ceil((ends[i + 1] - ends[i]) / (last - first) * kIntervals));
      const double width = (ends[i + 1] - ends[i]) / parts;
      for (int part = 0; part < parts; ++part)
        for (const GaussPoint& gauss : kGauss2) {
          const double x = ends[i] + (part + gauss.position) * width;
          const double weight = gauss.weight * width * channel.response.at(x);
          if (weight == 0.0) continue;
          wavelength_um.push_back(x);
          response.push_back(weight);
          total += weight;
        }
    }
    for (double& weight : response) weight /= total;
  }
  irradiance = sampled(solar_irradiance);
  for (std::size_t q = 0; q < size(); ++q) bright.push_back(reference_radiance(wavelength_um[q], irradiance[q]));
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
