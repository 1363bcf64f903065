#include "io/quantities/converted_quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/format.h"
#include "render/column_conversions.h"
#include "render/image_info.h"
#include "sampling/tile.h"

namespace ifov::io::quantities {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Place {
  std::size_t channel;
  int column;
};

/// Of a value of a tile.
Place place_of(const FinishedTile& of, std::size_t value) {
  const std::size_t channels = of.image.channels.size();
  const auto width = static_cast<std::size_t>(of.tile.tile.width());
  return {value % channels, of.tile.tile.x0 + static_cast<int>(value / channels % width)};
}

/// Of a radiance, or of how far it may be off: reflectance is a multiple of it.
void put_over_sunlight(const FinishedTile& of, std::span<const float> radiance, ValueSink& sink) {
  std::vector<float> values(radiance.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Place at = place_of(of, i);
    const double sunlight = render::toa_irradiance(of.image, at.channel, at.column);
    values[i] = static_cast<float>(
        sunlight > 0.0 ? std::numbers::pi * static_cast<double>(radiance[i]) / sunlight : kUnknown);
  }
  sink.put(values);
}

constexpr double kPerNm = 0.1;  // uW cm-2 nm-1 of 1 W m-2 um-1

void put_per_nm(std::span<const float> radiance, ValueSink& sink) {
  std::vector<float> values(radiance.size());
  std::transform(radiance.begin(), radiance.end(), values.begin(),
                 [](float value) { return static_cast<float>(kPerNm * static_cast<double>(value)); });
  sink.put(values);
}

/// Times what follows of the response of each pixel's column.
template <class Of>
void put_times(const FinishedTile& of, std::span<const float> radiance, const Of& factor, ValueSink& sink) {
  const std::size_t channels = of.image.channels.size();
  const auto width = static_cast<std::size_t>(of.tile.tile.width());
  std::vector<double> factors(channels * width);
  for (std::size_t i = 0; i < factors.size(); ++i)
    factors[i] = factor(of.image, i % channels, of.tile.tile.x0 + static_cast<int>(i / channels));
  std::vector<float> values(radiance.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(factors[i % factors.size()] * static_cast<double>(radiance[i]));
  sink.put(values);
}

/// Of light of one wavelength, photons of 1 W s are its wavelength over h c.
double photons_of_joule(const render::ImageInfo& image, std::size_t channel, int column) {
  constexpr double kJouleUm = 6.62607015e-34 * 299792458.0 * 1e6;  // h c, exact (SI 2019)
  return render::mean_wavelength_um(image, channel, column) / kJouleUm;
}

void put_toa_reflectance(const FinishedTile& of, ValueSink& sink) {
  put_over_sunlight(of, of.tile.mean, sink);
}

void put_toa_half_width(const FinishedTile& of, ValueSink& sink) {
  put_over_sunlight(of, of.tile.half_width, sink);
}

double kelvin(const FinishedTile& of, std::size_t value, double radiance) {
  const Place at = place_of(of, value);
  return render::brightness_kelvin(of.image, at.channel, at.column, radiance);
}

void put_brightness(const FinishedTile& of, ValueSink& sink) {
  std::vector<float> values(of.tile.mean.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(kelvin(of, i, static_cast<double>(of.tile.mean[i])));
  sink.put(values);
}

/// The further of the ends of the radiance's interval: temperature rises with radiance, so that it holds the true one as often.
void put_brightness_half_width(const FinishedTile& of, ValueSink& sink) {
  std::vector<float> values(of.tile.half_width.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double radiance = static_cast<double>(of.tile.mean[i]),
                 reach = static_cast<double>(of.tile.half_width[i]), middle = kelvin(of, i, radiance);
    const double low = radiance > reach ? kelvin(of, i, radiance - reach) : 0.0;
    values[i] = static_cast<float>(std::max(middle - low, kelvin(of, i, radiance + reach) - middle));
  }
  sink.put(values);
}

/// What makes reflectance of radiance and back.
void tell_sunlight(EnviHeader& header, const render::ImageInfo& image) {
  std::string list;
  for (const render::ChannelInfo& channel : image.channels)
    list += format("{}{:.9g}", list.empty() ? "" : ", ", channel.toa_irradiance);
  header.other["toa irradiance (W m-2 um-1)"] = list;
}

/// By channel, of the radiance of pixels.
constexpr Quantity converted(std::string_view name, std::string_view what, std::string_view unit,
                             Quantity::Needs needs, void (*values)(const FinishedTile&, ValueSink&)) {
  needs.radiance = true;
  return {.name = name,
          .what = what,
          .unit = unit,
          .role = Quantity::Role::radiance,
          .statistic = Quantity::Statistic::mean,
          .type = EnviType::float32,
          .bands = Quantity::Bands::channels,
          .band_names = {},
          .needs = needs,
          .values = values};
}

/// And of its half-width.
constexpr Quantity half_width(std::string_view name, std::string_view what, std::string_view unit,
                              Quantity::Needs needs, void (*values)(const FinishedTile&, ValueSink&)) {
  Quantity quantity = converted(name, what, unit, needs, values);
  quantity.role = Quantity::Role::error;
  quantity.statistic = Quantity::Statistic::half_width;
  quantity.needs.errors = true;
  return quantity;
}

constexpr Quantity over_sunlight(Quantity quantity) {
  quantity.needs.sunlight = true;
  quantity.complete_header = tell_sunlight;
  return quantity;
}

constexpr Quantity::Needs kResponses{.responses = true};
constexpr std::string_view kPerNmUnit = "uW cm-2 sr-1 nm-1", kPhotonUnit = "s-1 m-2 sr-1 um-1";

}  // namespace

constinit const Quantity kRadiancePerNm =
    converted("radiance_per_nm", "radiance in uW cm-2 sr-1 nm-1", kPerNmUnit, {},
              [](const FinishedTile& of, ValueSink& sink) { put_per_nm(of.tile.mean, sink); });
constinit const Quantity kRadiancePerNmHalfWidth = half_width(
    "radiance_per_nm_half_width", "half-width of the interval of the radiance in uW cm-2 sr-1 nm-1",
    kPerNmUnit, {}, [](const FinishedTile& of, ValueSink& sink) { put_per_nm(of.tile.half_width, sink); });

constinit const Quantity kBandRadiance =
    converted("band_radiance", "radiance within the channel, of the response with a maximum of 1",
              "W m-2 sr-1", kResponses, [](const FinishedTile& of, ValueSink& sink) {
                put_times(of, of.tile.mean, render::band_width_um, sink);
              });
constinit const Quantity kBandRadianceHalfWidth =
    half_width("band_radiance_half_width", "half-width of the interval of the radiance within the channel",
               "W m-2 sr-1", kResponses, [](const FinishedTile& of, ValueSink& sink) {
                 put_times(of, of.tile.half_width, render::band_width_um, sink);
               });

constinit const Quantity kPhotonRadiance = converted(
    "photon_radiance", "photons, of radiance that is even over the channel", kPhotonUnit, kResponses,
    [](const FinishedTile& of, ValueSink& sink) { put_times(of, of.tile.mean, photons_of_joule, sink); });
constinit const Quantity kPhotonRadianceHalfWidth =
    half_width("photon_radiance_half_width", "half-width of the interval of the photons", kPhotonUnit,
               kResponses, [](const FinishedTile& of, ValueSink& sink) {
                 put_times(of, of.tile.half_width, photons_of_joule, sink);
               });

constinit const Quantity kToaReflectance =
    over_sunlight(converted("toa_reflectance", "reflectance at the sensor", "1", {}, put_toa_reflectance));
constinit const Quantity kToaReflectanceHalfWidth = over_sunlight(
    half_width("toa_reflectance_half_width", "half-width of the interval of the reflectance at the sensor",
               "1", {}, put_toa_half_width));

constinit const Quantity kBrightnessTemperature =
    converted("brightness_temperature", "brightness temperature by the channel's response", "K", kResponses,
              put_brightness);
constinit const Quantity kBrightnessTemperatureHalfWidth = half_width(
    "brightness_temperature_half_width", "half-width of the interval of the brightness temperature", "K",
    kResponses, put_brightness_half_width);

}  // namespace ifov::io::quantities
