#include "session/detection/detected_values.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/format.h"
#include "ifov/detect.h"
#include "render/image_info.h"
#include "sensor/detector/detector.h"

namespace ifov::session {
namespace {

template <class Number>
std::string list_of(std::span<const render::ChannelInfo> channels, const Number& number) {
  std::string text;
  for (const render::ChannelInfo& channel : channels)
    text += format("{}{:.9g}", text.empty() ? "" : ", ", number(channel));
  return text;
}

template <class T, class Value>
void append(std::size_t count, const Value& value, std::vector<std::byte>& values) {
  const std::size_t before = values.size();
  values.resize(before + count * sizeof(T));
  for (std::size_t k = 0; k < count; ++k) {
    const T one = static_cast<T>(value(k));
    std::memcpy(values.data() + before + k * sizeof(T), &one, sizeof(T));
  }
}

void describe_counts(io::EnviHeader& header, std::span<const render::ChannelInfo> channels) {
  const double bits = std::max_element(channels.begin(), channels.end(), [](const auto& a, const auto& b) {
                        return a.detector->bits < b.detector->bits;
                      })->detector->bits;
  header.data_type = bits > 16.0 ? io::EnviType::uint32 : io::EnviType::uint16;
  header.data_units = std::string("counts");
  header.other["data gain values"] = list_of(channels, [](const render::ChannelInfo& channel) {
    return channel.detector->gain / channel.detector->electrons_per_radiance;
  });
  header.other["data offset values"] = list_of(channels, [](const render::ChannelInfo& channel) {
    return channel.detector->radiance_w_m2_sr_um(channel.detector->signal_of_count(0.0));
  });
}

}  // namespace

io::EnviHeader detected_header(io::EnviHeader header, DetectedQuantity quantity,
                               std::span<const render::ChannelInfo> channels, const std::string& radiance,
                               std::uint64_t seed) {
  header.data_type = io::EnviType::float32;
  const auto drawn = [&](const char* what) {
    return format("{} {} drawn by ifov detect, seed {}", radiance, what, seed);
  };
  switch (quantity) {
    case DetectedQuantity::radiance:
      header.description = drawn("with the sensor's noise");
      header.other["noise standard deviation"] =
          list_of(channels, [](const render::ChannelInfo& channel) { return channel.noise; });
      break;
    case DetectedQuantity::electrons:
      header.description = drawn("as electrons of the detector,");
      header.data_units = std::string("electrons");
      break;
    case DetectedQuantity::counts:
      header.description = drawn("as counts of the detector,");
      describe_counts(header, channels);
      break;
    case DetectedQuantity::kelvins:
      header.description = drawn("with the sensor's noise as brightness temperatures,");
      header.data_units = std::string("K");
      break;
    case DetectedQuantity::toa_reflectance:
      header.description = drawn("with the sensor's noise as reflectance at the sensor,");
      header.data_units = std::string("1");
      break;
  }
  return header;
}

void append_detected(const sensor::Detector& detector, DetectedQuantity quantity, io::EnviType type,
                     std::span<const double> signal, std::span<const double> light, const RadianceAs& as,
                     std::vector<std::byte>& values) {
  const auto count = [&](std::size_t k) { return detector.count(signal[k]); };
  const auto radiance_of = [&](std::size_t k) {
    const bool rounds = detector.digitises() && !std::isnan(signal[k]);
    const double radiance = detector.radiance_w_m2_sr_um(
        rounds ? detector.signal_of_count(detector.count(signal[k])) : signal[k]);
    return light.empty() ? radiance : radiance / light[k];
  };
  switch (quantity) {
    case DetectedQuantity::radiance: append<float>(signal.size(), radiance_of, values); break;
    case DetectedQuantity::electrons:
      append<float>(
          signal.size(), [&](std::size_t k) { return signal[k]; }, values);
      break;
    case DetectedQuantity::counts:
      if (type == io::EnviType::uint16)
        append<std::uint16_t>(signal.size(), count, values);
      else
        append<std::uint32_t>(signal.size(), count, values);
      break;
    case DetectedQuantity::kelvins:
      append<float>(
          signal.size(), [&](std::size_t k) { return as(k, radiance_of(k)); }, values);
      break;
    case DetectedQuantity::toa_reflectance:
      append<float>(
          signal.size(), [&](std::size_t k) { return as(k, radiance_of(k)); }, values);
      break;
  }
}

void append_values(std::span<const float> radiance, const RadianceAs& as, std::vector<std::byte>& values) {
  append<float>(
      radiance.size(), [&](std::size_t k) { return as(k, static_cast<double>(radiance[k])); }, values);
}

}  // namespace ifov::session
