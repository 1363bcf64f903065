#include "io/product_parts/picture.h"

#include <algorithm>
#include <cmath>

#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::io {

Layer averaged_layer(const RasterView& raster, int band, int factor) {
  Layer layer{(raster.width + factor - 1) / factor, (raster.height + factor - 1) / factor, {}};
  const auto width = static_cast<std::size_t>(layer.width), step = static_cast<std::size_t>(factor);
  layer.values.resize(width * static_cast<std::size_t>(layer.height));
  std::vector<float> line(static_cast<std::size_t>(raster.width));
  std::vector<double> sum(width);
  std::vector<int> count(width);
  for (int row = 0; row < layer.height; ++row) {
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(count.begin(), count.end(), 0);
    for (int y = row * factor; y < std::min((row + 1) * factor, raster.height); ++y) {
      raster.read(y, band, line);
      for (std::size_t x = 0; x < line.size(); ++x) {
        if (!std::isfinite(line[x])) continue;
        sum[x / step] += line[x];
        ++count[x / step];
      }
    }
    for (std::size_t x = 0; x < width; ++x)
      layer.values[static_cast<std::size_t>(row) * width + x] = static_cast<float>(sum[x] / count[x]);
  }
  return layer;
}

Range percentiles(const Layer& layer, double low, double high) {
  std::vector<float> sorted;
  for (const float value : layer.values)
    if (std::isfinite(value)) sorted.push_back(value);
  if (sorted.empty()) return {};
  const auto at = [&](double share) {
    const auto position =
        sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), position, sorted.end());
    return static_cast<double>(*position);
  };
  Range range{at(low), at(high)};
  if (range.high > range.low) return range;
  range = {at(0.0), at(1.0)};  // most of the image has one value: show the rest
  if (range.high > range.low) return range;
  const double margin = std::max(std::abs(range.low) * 1e-3, 1e-12);
  return {range.low - margin, range.high + margin};
}

bool all_visible(const std::vector<double>& centre_um) {
  constexpr double kViolet_um = 0.38, kRed_um = 0.75;
  return std::all_of(centre_um.begin(), centre_um.end(),
                     [](double um) { return um > kViolet_um && um < kRed_um; });
}

std::vector<Range> colour_ranges(const std::vector<Layer>& layers, const std::vector<double>& centre_um,
                                 double low, double high) {
  std::vector<Range> ranges;
  if (!all_visible(centre_um)) {
    for (const Layer& layer : layers) ranges.push_back(percentiles(layer, low, high));
    return ranges;
  }
  constexpr double kHalfWidth_um = 0.01;
  constexpr double kLuminance[] = {0.2126, 0.7152, 0.0722};  // of linear sRGB's red, green and blue
  constexpr double kHaze = 0.2;
  std::vector<double> sunlight;
  Layer luminance;
  luminance.values.resize(layers.front().values.size());
  for (std::size_t k = 0; k < layers.size(); ++k) {
    sunlight.push_back(radiometry::integral(radiometry::solar_irradiance_1au(), centre_um[k] - kHalfWidth_um,
                                            centre_um[k] + kHalfWidth_um));
    for (std::size_t i = 0; i < luminance.values.size(); ++i)
      luminance.values[i] += static_cast<float>(kLuminance[k] / sunlight[k] * layers[k].values[i]);
  }
  Range joint = percentiles(luminance, low, high);
  if (joint.low < kHaze * joint.high) joint.low = std::min(joint.low, 0.0);
  for (const double weight : sunlight) ranges.push_back({joint.low * weight, joint.high * weight});
  return ranges;
}

int averaging_factor(int width, int height) {
  constexpr int kLongestSide = 1600;
  return (std::max(width, height) + kLongestSide - 1) / kLongestSide;
}

std::vector<Range> colour_ranges(const RasterView& radiance, const render::ImageInfo& info,
                                 const std::vector<int>& channels) {
  std::vector<Layer> layers;
  std::vector<double> centre_um;
  for (const int channel : channels) {
    layers.push_back(averaged_layer(radiance, channel, averaging_factor(radiance.width, radiance.height)));
    centre_um.push_back(info.channels[static_cast<std::size_t>(channel)].centre_um);
  }
  return colour_ranges(layers, centre_um, kLowShare, kHighShare);
}

bool is_thermal(const render::ImageInfo& info, int channel) {
  return info.channels[static_cast<std::size_t>(channel)].centre_um > 3.0 &&
         info.radiance_unit == "W m-2 sr-1 um-1";
}

void to_brightness_temperature_k(Layer& layer, double wavelength_um) {
  for (float& value : layer.values)
    value = static_cast<float>(radiometry::brightness_temperature_k(wavelength_um, value));
}

}  // namespace ifov::io
