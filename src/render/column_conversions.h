#pragma once

#include <cstddef>
#include <string>

namespace ifov::render {

struct ImageInfo;

/// Of a pixel in a column: irradiance by the Sun above the air, and the temperature at which a blackbody has this radiance (not a
/// number where the response is not known).
double toa_irradiance(const ImageInfo& image, std::size_t channel, int column);
double brightness_kelvin(const ImageInfo& image, std::size_t channel, int column, double radiance);

/// Width of an even response of the same maximum and area, um: by it a mean radiance is one within the channel. Not a number of a single
/// wavelength, or where the response is not known.
double band_width_um(const ImageInfo& image, std::size_t channel, int column);

/// Middle of the response, um: by it radiance that is even over the channel is a number of photons. Not a number where the response is not
/// known.
double mean_wavelength_um(const ImageInfo& image, std::size_t channel, int column);

/// The mosaic's rows with parentheses about each: "(red, green), (green, blue)".
std::string mosaic_pattern(const ImageInfo& image);

}  // namespace ifov::render
