#pragma once

#include <string>
#include <vector>

#include "io/envi/colour_map.h"
#include "io/product_parts/raster_view.h"
#include "render/tile_sink.h"

namespace ifov::io {

/// Values of one channel at the picture's pixels.
struct Layer {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// One band, averaged over squares of `factor` pixels (what is left over at the right and lower rim is
/// averaged over fewer); values that are not finite are left out.
Layer averaged_layer(const RasterView& raster, int band, int factor);

/// Values below which the shares `low` and `high` (in [0, 1]) of the finite values lie.
struct Range {
  double low = 0.0, high = 1.0;
};
Range percentiles(const Layer& layer, double low, double high);

/// Ranges of the three layers of a colour picture. Those of visible wavelengths share one, each as a part of sunlight at
/// its wavelength (radiometry::solar_irradiance_1au, mean of 20 nm), so that what is grey looks grey: from 0, or under haze,
/// where the dark end lies above a fifth of the bright one, from there, to the percentile `high` of the luminance. Others
/// each have their own, between their percentiles of `low` and `high`.
std::vector<Range> colour_ranges(const std::vector<Layer>& layers, const std::vector<double>& centre_um,
                                 double low, double high);
/// The same of an image as its pictures show it.
std::vector<Range> colour_ranges(const RasterView& radiance, const render::ImageInfo& info,
                                 const std::vector<int>& channels);
bool all_visible(const std::vector<double>& centre_um);

/// Percentiles of pictures.
inline constexpr double kLowShare = 0.01, kHighShare = 0.99;

/// How many pixels to each side a picture shows as one.
int averaging_factor(int width, int height);

/// True where emission outweighs sunlight: pictures then show brightness temperature.
bool is_thermal(const render::ImageInfo& info, int channel);

/// Radiance to the temperature of a black body of the same radiance, in place.
void to_brightness_temperature_k(Layer& layer, double wavelength_um);

}  // namespace ifov::io
