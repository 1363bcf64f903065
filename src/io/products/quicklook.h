#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"
#include "io/products/product_format.h"

namespace ifov::io {

/// A PNG for people: three channels in colour, or one through a colour map with its bar (brightness
/// temperature in the thermal infrared), with title, range, scale bar and accuracy. `channels`: three, one,
/// or empty for a choice by wavelength. Throws SystemError where it cannot be drawn.
std::string make_quicklook(const RasterView& radiance, const RunRecord& record,
                           const std::vector<int>& channels);

/// The colours of that picture alone.
struct PictureColours {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB, rows from the top; grey where there is no value
};
PictureColours picture_colours(const RasterView& radiance, const RunRecord& record,
                               const std::vector<int>& channels);

namespace formats {
extern const ProductFormat kPng;
}

}  // namespace ifov::io
