#include "radiometry/channel.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "radiometry/channel_grid.h"
#include "radiometry/gauss_legendre.h"
#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr double kFwhmPerSigma = 2.3548200450309493;  // 2 sqrt(2 ln 2)

double centroid_um(const Spectrum& response) {
  const Spectrum wavelength({response.first_um(), response.last_um()},
                            {response.first_um(), response.last_um()});
  return weighted_mean(wavelength, response);
}

/// Distance between the outermost crossings of half the maximum.
double full_width_um(const Spectrum& response) {
  const auto x = response.wavelength_um();
  const auto y = response.values();
  const double half = 0.5 * response.maximum();
  std::size_t first = 0, last = y.size() - 1;
  while (y[first] < half) ++first;
  while (y[last] < half) --last;
  const auto crossing = [&](std::size_t below, std::size_t above) {
    return x[below] + (half - y[below]) / (y[above] - y[below]) * (x[above] - x[below]);
  };
  const double low = first == 0 ? x[0] : crossing(first - 1, first);
  const double high = last + 1 == y.size() ? x[last] : crossing(last + 1, last);
  return high - low;
}

/// Mean over the response of a smooth function that may change by orders of magnitude within the channel.
template <class Function>
double mean_of(const Channel& channel, const Function& function) {
  if (channel.is_monochromatic()) return function(channel.centre_um);
  const auto x = channel.response.wavelength_um();
  const std::vector<double> steps = integration_steps_um({x.begin(), x.end()});
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const double width = steps[i + 1] - steps[i];
    for (const GaussPoint& gauss : kGauss4) {
      const double wavelength = steps[i] + gauss.position * width;
      const double weight = gauss.weight * width * channel.response.at(wavelength);
      sum += weight * function(wavelength);
      total += weight;
    }
  }
  return sum / total;
}

}  // namespace

Channel Channel::gaussian(std::string name, double centre_um, double fwhm_um) {
  constexpr int kSteps = 256;
  constexpr double kReach = 4.0;  // standard deviations
  const double sigma = fwhm_um / kFwhmPerSigma;
  if (!(fwhm_um > 0.0) || !(centre_um > kReach * sigma))
    throw InputError(format("channel '{}': a Gaussian at {:g} um with a width of {:g} um is not possible",
                            name, centre_um, fwhm_um));
  std::vector<double> wavelength, response;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = kReach * (2.0 * i / kSteps - 1.0);
    wavelength.push_back(centre_um + z * sigma);
    response.push_back(std::exp(-0.5 * z * z));
  }
  Spectrum table(std::move(wavelength), std::move(response), OutsideRange::zero, name);
  return {std::move(name), std::move(table), centre_um, fwhm_um};
}

Channel Channel::top_hat(std::string name, double first_um, double last_um) {
  if (!(first_um > 0.0) || !(last_um > first_um))
    throw InputError(
        format("channel '{}': no top hat reaches from {:g} to {:g} um", name, first_um, last_um));
  Spectrum table({first_um, last_um}, {1.0, 1.0}, OutsideRange::zero, name);
  return {std::move(name), std::move(table), 0.5 * (first_um + last_um), last_um - first_um};
}

Channel Channel::tabulated(std::string name, const Spectrum& response) {
  if (response.wavelength_um().size() < 2 || !(response.maximum() > 0.0))
    throw InputError(
        format("channel '{}': a response needs two wavelengths or more and a value above 0", name));
  Spectrum table = response.mapped([](double value) { return std::max(value, 0.0); })
                       .with_outside(OutsideRange::zero)
                       .with_name(name);
  const double centre_um = centroid_um(table), fwhm_um = full_width_um(table);
  return {std::move(name), std::move(table), centre_um, fwhm_um};
}

Channel Channel::monochromatic(std::string name, double wavelength_um) {
  if (!(wavelength_um > 0.0))
    throw InputError(format("channel '{}': a wavelength of {:g} um is not possible", name, wavelength_um));
  return {std::move(name), Spectrum::constant(1.0), wavelength_um, 0.0};
}

double channel_mean(const Channel& channel, const Spectrum& spectrum) {
  return channel.is_monochromatic() ? spectrum.at(channel.centre_um)
                                    : weighted_mean(spectrum, channel.response);
}

double channel_planck_w_m2_sr_um(const Channel& channel, double temperature_k) {
  return mean_of(channel,
                 [&](double wavelength_um) { return planck_w_m2_sr_um(wavelength_um, temperature_k); });
}

double channel_planck_slope_w_m2_sr_um_k(const Channel& channel, double temperature_k) {
  return mean_of(
      channel, [&](double wavelength_um) { return planck_slope_w_m2_sr_um_k(wavelength_um, temperature_k); });
}

double channel_brightness_temperature_k(const Channel& channel, double radiance_w_m2_sr_um) {
  if (!(radiance_w_m2_sr_um > 0.0)) return 0.0;
  // Newton on ln L over 1/T, along which Planck's law is nearly straight: a few steps from any start.
  double temperature = brightness_temperature_k(channel.centre_um, radiance_w_m2_sr_um);
  for (int step = 0; step < 50; ++step) {
    const double radiance = channel_planck_w_m2_sr_um(channel, temperature);
    const double slope = channel_planck_slope_w_m2_sr_um_k(channel, temperature);
    if (!(radiance > 0.0) || !(slope > 0.0)) break;
    const double change = std::log(radiance_w_m2_sr_um / radiance) * radiance / slope;  // of T, first order
    const double next = 1.0 / (1.0 / temperature - change / (temperature * temperature));
    const double bounded =
        next > 0.0 ? std::clamp(next, 0.5 * temperature, 2.0 * temperature) : 2.0 * temperature;
    const bool done = std::abs(bounded - temperature) <= 1e-12 * temperature;
    temperature = bounded;
    if (done) break;
  }
  return temperature;
}

}  // namespace ifov::radiometry
