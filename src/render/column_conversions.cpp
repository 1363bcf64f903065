#include "render/column_conversions.h"

#include <cmath>
#include <limits>
#include <span>

#include "radiometry/spectrum.h"
#include "render/image_info.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/mosaic.h"
#include "sensor/spectrometer/column_responses.h"

namespace ifov::render {
namespace {

/// A channel's by what is carried of it.
template <class Of>
double weighted(const ImageInfo& image, std::size_t channel, int column, const Of& of) {
  const std::span<const float> weights = image.responses->weights(channel, column);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += static_cast<double>(weights[k]) * of(k);
  return sum;
}

/// Of the response of a pixel's column; not a number where it is not known.
template <class Of>
double of_response(const ImageInfo& image, std::size_t channel, int column, const Of& of) {
  const ChannelInfo& told = image.channels[channel];
  if (!told.brightness) return std::numeric_limits<double>::quiet_NaN();
  if (!image.responses || (*image.responses)[channel].carried.size() < 2)
    return of(told.brightness->channel());
  const std::vector<sensor::BrightnessScale>& scales = image.responses->scales(channel);
  return weighted(image, channel, column, [&](std::size_t k) { return of(scales[k].channel()); });
}

}  // namespace

double toa_irradiance(const ImageInfo& image, std::size_t channel, int column) {
  const ChannelInfo& of = image.channels[channel];
  if (of.toa_of_carried.empty()) return of.toa_irradiance;
  return weighted(image, channel, column, [&](std::size_t k) { return of.toa_of_carried[k]; });
}

double brightness_kelvin(const ImageInfo& image, std::size_t channel, int column, double radiance) {
  const ChannelInfo& of = image.channels[channel];
  if (!of.brightness) return std::numeric_limits<double>::quiet_NaN();
  if (!image.responses || (*image.responses)[channel].carried.size() < 2 || !(radiance > 0.0))
    return of.brightness->kelvin(radiance);
  const std::vector<sensor::BrightnessScale>& scales = image.responses->scales(channel);
  // Newton in the logarithm of radiance over 1/T, along which it is nearly straight.
  const auto log_radiance = [&](double per_kelvin) {
    return std::log(weighted(image, channel, column,
                             [&](std::size_t k) { return scales[k].radiance_w_m2_sr_um(1.0 / per_kelvin); }));
  };
  const double wanted = std::log(radiance);
  double x = 1.0 / of.brightness->kelvin(radiance);
  for (int step = 0; step < 4; ++step) {
    constexpr double kStep = 1e-4;
    const double at = log_radiance(x), slope = (log_radiance(x * (1.0 + kStep)) - at) / (x * kStep);
    const double change = (wanted - at) / slope;
    if (!std::isfinite(change)) break;
    x += change;
    if (std::abs(change) < 1e-9 * x) break;
  }
  return 1.0 / x;
}

double band_width_um(const ImageInfo& image, std::size_t channel, int column) {
  return of_response(image, channel, column, [](const radiometry::Channel& whose) {
    const radiometry::Spectrum& response = whose.response;
    return whose.is_monochromatic()
               ? std::numeric_limits<double>::quiet_NaN()
               : radiometry::integral(response, response.first_um(), response.last_um()) / response.maximum();
  });
}

double mean_wavelength_um(const ImageInfo& image, std::size_t channel, int column) {
  return of_response(image, channel, column,
                     [](const radiometry::Channel& whose) { return whose.centre_um; });
}

std::string mosaic_pattern(const ImageInfo& image) {
  std::string text;
  const sensor::Mosaic& mosaic = *image.mosaic;
  for (int y = 0; y < mosaic.rows; ++y) {
    text += y > 0 ? ", (" : "(";
    for (int x = 0; x < mosaic.columns; ++x)
      text += (x > 0 ? ", " : "") + image.channels[static_cast<std::size_t>(mosaic.channel_at(x, y))].name;
    text += ")";
  }
  return text;
}

}  // namespace ifov::render
