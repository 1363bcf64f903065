#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/product_parts/raster_view.h"

namespace ifov::io {

/// Bytes as base64 text (RFC 4648).
std::string base64(std::string_view bytes);

/// Text that may stand in HTML, also within double quotes.
std::string escape_html(std::string_view text);

/// Bands of a raster as 16-bit codes, little endian, band after band: value = low + code (high - low) / 65534
/// with each band's own range; 65535 stands for "not finite". Every `step`-th pixel of every `step`-th line.
struct QuantisedRaster {
  int width = 0, height = 0;
  std::vector<double> low, high;
  std::string codes;
};
QuantisedRaster quantise(const RasterView& raster, int bands, int step);

/// Counts of one band's finite values in equal bins; logarithmic bins where the largest positive value is
/// more than 30 times the smallest.
struct Histogram {
  std::vector<double> edges;  ///< one more than counts
  std::vector<std::size_t> counts;
  bool logarithmic = false;
};
Histogram histogram(const RasterView& raster, int band, int bins, bool whole = false);

/// Smallest step at which ceil(width / step) * ceil(height / step) * bytes_per_pixel <= limit_bytes.
int thinning_step(int width, int height, std::size_t bytes_per_pixel, std::size_t limit_bytes);

}  // namespace ifov::io
